#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// How large a map looks from the camera where it looks largest, if it stood across the light's ray
/// and across the line of sight. Only ratios between projections have a meaning. (Lloyd et al.,
/// Warping and Partitioning for Low Error Shadow Maps, 2006, section 3.)
struct PerspectiveAliasing
{
  /// Of a step of 1 in device coordinates, as the tangent of an angle, along the worse of both
  /// axes: what LiSPSM's parameter is the optimum of.
  double side = 0.0;
  /// Of a square of 1 in device coordinates, as a solid angle. How a surface lies to light and
  /// camera scales a texel's area by a factor that is the same for all projections: the ratio of
  /// two of them holds on every surface. (That of sides does not.)
  double area = 0.0;
};

/// The corners stand for the whole body: for parallel rays, sides and areas of a uniform map
/// (constants over powers of the distance) and of a perspective warp (powers of a linear function
/// over powers of the distance) are convex, and largest at one of them.
///
/// @param bodyView what the camera sees, in the light's view space, before the eye of a perspective
/// @return 0 without points
PerspectiveAliasing perspectiveAliasing(const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays, const glm::dmat3& mapFromAcross);

} // namespace gnomon
