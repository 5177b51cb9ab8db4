#pragma once

#include "plugin/frame/FrameWishes.h"

#include <string>

namespace gnomon
{

/// How visibility reaches the shader.
enum class Route
{
  Inline, ///< VTK's fragment shader computes it
  Image   ///< it is computed for all pixels beforehand, and fetched
};

/// Which route a frame takes, and why.
struct RouteChoice
{
  Route route = Route::Inline;
  std::string reason; ///< as a clause
};

/// @param wished inline is not served for techniques that work on the screen
/// @param screenTechnique one of those, among the frame's; empty: there is none
RouteChoice chooseRoute(RouteWish wished, const std::string& screenTechnique, bool keepVisibility);

} // namespace gnomon
