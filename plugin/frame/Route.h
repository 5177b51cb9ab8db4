#pragma once

#include "plugin/frame/FrameWishes.h"

#include <cstddef>
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

/// The most lights whose techniques VTK's shaders call. Each makes the program longer, which takes
/// longer to compile, and binds its map to a texture unit. OpenGL promises 16 of them, and VTK's
/// materials take some.
inline constexpr std::size_t mostInlineLights = 8;

/// @param wished inline is not served for techniques that work on the screen
/// @param screenTechnique one of those, among the frame's; empty: there is none
/// @param lights that cast
RouteChoice chooseRoute(
  RouteWish wished, const std::string& screenTechnique, bool keepVisibility, std::size_t lights);

} // namespace gnomon
