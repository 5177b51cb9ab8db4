#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The largest size at which the camera sees a map's texels, for surfaces across the light's ray
/// and the line of sight. Only ratios between projections have a meaning (Lloyd et al., Warping and
/// Partitioning for Low Error Shadow Maps, 2006, section 3).
struct PerspectiveAliasing
{
  /// The size of a step of 1 in device coordinates along the worse axis, as the tangent of an
  /// angle. LiSPSM's parameter minimises it.
  double side = 0.0;
  /// The size of a unit square in device coordinates, as a solid angle. A surface's orientation
  /// scales a texel's area by the same factor for all projections, so ratios of areas hold on every
  /// surface. Ratios of sides do not.
  double area = 0.0;
};

/// Return the largest aliasing over a body's corners, which bounds the whole body for parallel
/// rays. There, sides and areas are convex functions, largest at a corner. For a uniform map they
/// are constants over powers of the distance, for a warp powers of a linear function over powers of
/// the distance.
///
/// @param bodyView corners of the visible body, in the light's view space, in front of a
/// perspective camera's eye
/// @return 0 without points
PerspectiveAliasing perspectiveAliasing(const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays, const glm::dmat3& mapFromAcross);

} // namespace gnomon
