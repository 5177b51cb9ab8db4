#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace gnomon
{

/// The common frame of a map's perspective warps (Lispsm.h, Trapezoid.h). They look along the
/// direction of view as the light sees it, and differ only in the near distance.
struct WarpFrame
{
  /// A rotation and an offset. The image of the camera's axis becomes x = 0; y grows with distance
  /// from the camera, and y = 0 lies at the nearest visible point. If the axis misses the visible
  /// body, x = 0 is the body's side nearest to the axis.
  glm::dmat3 frameFromAcross{ 1.0 };
  /// Visible points lie between y = 0 and y = depth, > 0.
  double depth = 0.0;

  /// The distances of visible points from the eye, 0 < nearest < farthest.
  double nearest = 0.0;
  double farthest = 0.0;

  /// The angle between light and direction of view, in [0, 180]. A positional light's direction is
  /// the ray through the mean of the visible points.
  double gammaDegrees = 0.0;
  /// Half the camera's field of view in the plane of both, in [0, 90).
  double thetaDegrees = 0.0;
};

/// Return the warps' frame for a visible body.
/// @param bodyView the body's vertices, in the light's view space
/// @return nothing if there is no useful perspective across the light: for a parallel camera, light
/// along the view, a light on the camera's axis, no visible points, or a body without depth
std::optional<WarpFrame> warpFrame(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// Return the perspective from a point `nearWarp` before y = 0 of the frame, fitted to the points.
/// It is x / y' and (f + n) / (f - n) - 2 f n / ((f - n) y'), with n = nearWarp, f = n + depth, y'
/// = n + y (Wimmer, Scherzer, Purgathofer 2004, section 3.2).
///
/// Its w is positive over everything visible, and its determinant is positive.
/// @param nearWarp > 0
glm::dmat3 warpedFromAcross(
  const WarpFrame& frame, double nearWarp, const std::vector<glm::dvec2>& across);

/// Return the share of a warp's perspective to use, in [-1, 0]: 0 all of it, -1 none. Along a
/// frustum's axis, the light sees the near end inside the far end, and a warp between them harms.
///
/// Lloyd, Logarithmic Perspective Shadow Maps (thesis, 2007), section 5.2: with gamma_a = theta/3,
/// gamma_b = theta, gamma_c = theta + 0.3 (90 - theta), eta_b = -0.2, eta_c = 0:
///   -1                                                                      gamma < gamma_a
///   -1 + (eta_b + 1) (1 - cos(90 (gamma - gamma_a) / (gamma_b - gamma_a)))  up to gamma_b
///   eta_b + (eta_c - eta_b) sin(90 (gamma - gamma_b) / (gamma_c - gamma_b)) up to gamma_c
///   eta_c                                                                   beyond
/// The thesis prints 0 and 1 + cos for the first two, which would jump.
///
/// @param gammaDegrees angle between light and view, in [0, 180]; the result is the same for 180 -
/// gamma
/// @param thetaDegrees half the field of view, in [0, 90]
double warpEta(double gammaDegrees, double thetaDegrees);

/// Return a near distance moved away by warpEta(), in units of the frame's depth: (n - eta) / (1 +
/// eta), infinite for eta = -1 (Lloyd 2007, section 5.1.2.2, n' for eta <= 0).
double fallOff(const WarpFrame& frame, double nearWarp);

/// Return the near distance with the least perspective aliasing over the body
/// (PerspectiveAliasing::side), in units of the frame's depth, in [1e-4, 1e4].
double leastAliasingNear(const WarpFrame& frame, const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays);

/// A perspective is used if its worst texel's area is below this share of the uniform projection's.
/// Smaller gains are not worth texels that move with the camera. On surfaces askew to the map's
/// axes, part of the gain is lost along a texel's worse side. On a plain under light from all
/// directions, this limit keeps the worst side at most 0.84 of the uniform one's under LiSPSM and
/// 1.23 under trapezoids. Without it, they are 1.8 and 2.5.
constexpr double largestAreaShare = 0.3;

/// Return the perspective with this near distance, in units of the frame's depth. Return the
/// uniform projection (uniformFromAcross) if that is about as good (largestAreaShare), or if the
/// near distance is infinite.
glm::dmat3 warpedOrUniform(const WarpFrame& frame, double nearWarp,
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
