#ifndef gnomon_lights_MapWarp_h
#define gnomon_lights_MapWarp_h

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace gnomon
{

/// What the perspective warps of a map (Lispsm.h, Trapezoid.h) have in common: they look along the
/// direction of view as the light sees it, and differ in the near distance only.
struct WarpFrame
{
  /// A rotation and an offset: the image of the camera's axis becomes x = 0, y grows with the distance
  /// from the camera, and y = 0 lies at the nearest of what is visible. Where the axis misses the
  /// visible body, x = 0 is the side of the body next to it.
  glm::dmat3 frameFromAcross{ 1.0 };
  /// What is visible reaches from y = 0 to here, > 0.
  double depth = 0.0;

  /// The distances from the eye of what is visible, 0 < nearest < farthest.
  double nearest = 0.0;
  double farthest = 0.0;

  /// The angle between light and direction of view, in [0, 180]. Of a positional light: the ray
  /// through the middle of what is visible.
  double gammaDegrees = 0.0;
  /// Half the camera's field of view in the plane of both, in [0, 90).
  double thetaDegrees = 0.0;
};

/// @param bodyView the visible body's vertices, in the light's view space
/// @return nothing where no perspective across the light makes sense: a parallel camera, light along
/// the view, a light on the camera's axis; nothing visible, or nothing that reaches into depth
std::optional<WarpFrame> warpFrame(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// From this near distance on, in units of the depth, the perspective is taken as uniform: it changes
/// the texels by less than a millionth.
constexpr double largestNearWarp = 1e6;

/// The perspective from a point `nearWarp` before y = 0 of the frame, fitted to the points:
/// x / y' and (f + n) / (f - n) - 2 f n / ((f - n) y'), with n = nearWarp, f = n + depth, y' = n + y.
/// (Wimmer, Scherzer, Purgathofer 2004, section 3.2.)
///
/// Its w is positive over all that is visible, its determinant positive.
glm::dmat3 warpedFromAcross(
  const WarpFrame& frame, double nearWarp, const std::vector<glm::dvec2>& across);

} // namespace gnomon

#endif
