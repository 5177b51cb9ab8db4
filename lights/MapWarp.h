#pragma once

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
  /// A rotation and an offset: the image of the camera's axis becomes x = 0, y grows with the
  /// distance from the camera, and y = 0 lies at the nearest of what is visible. Where the axis
  /// misses the visible body, x = 0 is the side of the body next to it.
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
/// @return nothing where no perspective across the light makes sense: a parallel camera, light
/// along the view, a light on the camera's axis; nothing visible, or nothing that reaches into
/// depth
std::optional<WarpFrame> warpFrame(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// The perspective from a point `nearWarp` before y = 0 of the frame, fitted to the points: x / y'
/// and (f + n) / (f - n) - 2 f n / ((f - n) y'), with n = nearWarp, f = n + depth, y' = n + y.
/// (Wimmer, Scherzer, Purgathofer 2004, section 3.2.)
///
/// Its w is positive over all that is visible, its determinant positive.
/// @param nearWarp > 0
glm::dmat3 warpedFromAcross(
  const WarpFrame& frame, double nearWarp, const std::vector<glm::dvec2>& across);

/// How much of a warp's perspective is used, in [-1, 0]: 0 all of it, -1 none. What the light sees
/// of a frustum along its axis has its near end inside of its far end, and a warp between them
/// harms.
///
/// Lloyd, Logarithmic Perspective Shadow Maps (thesis, 2007), section 5.2: with gamma_a = theta/3,
/// gamma_b = theta, gamma_c = theta + 0.3 (90 - theta), eta_b = -0.2, eta_c = 0:
///   -1                                                                      gamma < gamma_a
///   -1 + (eta_b + 1) (1 - cos(90 (gamma - gamma_a) / (gamma_b - gamma_a)))  up to gamma_b
///   eta_b + (eta_c - eta_b) sin(90 (gamma - gamma_b) / (gamma_c - gamma_b)) up to gamma_c
///   eta_c                                                                   beyond
/// (The thesis prints 0 and 1 + cos for the first two, which would jump; these join.)
///
/// @param gammaDegrees the angle between light and view, in [0, 180]; which way does not matter
/// @param thetaDegrees half the field of view, in [0, 90]
double warpEta(double gammaDegrees, double thetaDegrees);

/// A near distance, in units of the frame's depth, that is moved away as far as warpEta() says:
/// (n - eta) / (1 + eta), infinite for eta = -1. (Lloyd 2007, section 5.1.2.2, n' for eta <= 0.)
double fallOff(const WarpFrame& frame, double nearWarp);

/// The near distance, in units of the frame's depth, of the least perspective aliasing over the
/// body (PerspectiveAliasing::side), between 1e-4 and 1e4.
double leastAliasingNear(const WarpFrame& frame, const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays);

/// The area of the worst texel under a perspective, as a share of that under the uniform
/// projection, up to which the perspective is worth it: its texels move with the camera, and some
/// of the gain in area is lost again along the worse of a texel's sides, on surfaces askew to the
/// map's axes. Measured on a plain under light from all directions, up to here the worst side is at
/// most 0.84 of the uniform one's under LiSPSM, 1.23 under trapezoids; without a limit 1.8 and 2.5.
constexpr double largestAreaShare = 0.3;

/// The perspective with this near distance, in units of the frame's depth; the uniform projection
/// (uniformFromAcross) where that is about as good (largestAreaShare), and where the near distance
/// is infinite.
glm::dmat3 warpedOrUniform(const WarpFrame& frame, double nearWarp,
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
