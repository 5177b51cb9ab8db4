#pragma once

#include "plugin/frame/FrameWishes.h"

#include <cstddef>
#include <string>

namespace gnomon
{

/// How visibility reaches the picture.
enum class Route
{
  Inline, ///< VTK's fragment shader computes it
  Image,  ///< it is computed for all pixels beforehand, and fetched
  /// VTK's fragment shader gives each pixel's colour in light and in shadow, and which triangle it
  /// shows; visibility, computed afterwards, chooses.
  Deferred
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

/// What a frame's route depends on.
struct RouteNeeds
{
  std::string screenTechnique; ///< one that works on the screen; empty: there is none
  bool keepVisibility = false;
  std::size_t lights = 0; ///< that cast
  /// Whether a headlight casts in a window with several samples per pixel. The inline route asks
  /// for the centroid of the samples that a triangle covers, whether or not they are seen. Where
  /// another surface hides the centroid from the camera, it hides it from a headlight, too: edges
  /// would be dark in front of surfaces that are all lit.
  bool headlightOnSamples = false;
  std::string slowTechnique;  ///< one whose points take long (TechniqueInfo::isSlow), in a window
                              ///< with one sample per pixel; empty: there is none
  std::string whyNotDeferred; ///< as a clause; empty: the deferred route can be taken
};

/// As people call it: "inline", "image", "deferred".
const char* nameOf(Route route);

/// @param wished inline is not served for techniques that work on the screen, deferred not where
/// there is a reason against it
RouteChoice chooseRoute(RouteWish wished, const RouteNeeds& needs);

} // namespace gnomon
