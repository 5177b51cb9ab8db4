#pragma once

#include "plugin/plan/FrameWishes.h"

#include <cstddef>
#include <string>

namespace gnomon
{

/// How visibility reaches the picture.
enum class Route
{
  Inline, ///< VTK's fragment shader computes it
  Image,  ///< a stage computes it for all pixels, and the shader fetches it
  /// VTK's fragment shader writes each pixel's colour in light and in shadow, and its triangle.
  /// Visibility is computed afterwards and selects.
  Deferred
};

/// The programs that write triangle numbers.
enum class Numbering
{
  All,       ///< all, in frames that take them and in others
  Receivers, ///< image route: those that draw receivers and nothing else
  None
};

/// A frame's route, and why.
struct RouteChoice
{
  Route route = Route::Inline;
  std::string reason; ///< as a clause
};

/// The most lights whose techniques VTK's shaders call. Each makes the program longer to compile,
/// and binds its map to a texture unit. OpenGL guarantees 16 units, and VTK's materials need some.
inline constexpr std::size_t mostInlineLights = 8;

/// The inputs of a frame's route.
struct RouteNeeds
{
  std::string screenTechnique; ///< a technique that works on the screen; empty if there is none
  bool keepVisibility = false;
  bool seesSky = false;   ///< shaders read the view of the sky
  std::size_t lights = 0; ///< that cast
  /// True if a headlight casts in a window with several samples per pixel. The inline route uses
  /// the centroid of the samples that a triangle covers, visible or not. A surface that hides the
  /// centroid from the camera hides it from a headlight, too. So edges would be dark in front of
  /// surfaces that are all lit.
  bool headlightOnSamples = false;
  std::string slowTechnique;  ///< a technique that is slow at a point (TechniqueInfo::isSlow), with
                              ///< one sample per pixel; empty if there is none
  std::string whyNotDeferred; ///< as a clause; empty if the deferred route is possible
};

/// Return its name for users: "inline", "image", "deferred".
const char* nameOf(Route route);

/// Return the route of a frame.
/// @param wished inline is refused for techniques that work on the screen, deferred if there is a
/// reason against it
RouteChoice chooseRoute(RouteWish wished, const RouteNeeds& needs);

} // namespace gnomon
