#ifndef gnomon_lights_Lispsm_h
#define gnomon_lights_Lispsm_h

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Light space perspective shadow maps: a perspective across the light's rays, whose texels grow
/// with the distance from the camera (Wimmer, Scherzer, Purgathofer 2004, section 3). The map's y
/// axis lies along the direction of view as the light sees it, near points at the bottom.
///
/// The warp's near distance is the published optimum for the nearest visible point (lispsmNear), and
/// falls off to the uniform map as light and view become parallel, either way (lispsmEta).
///
/// @param bodyView the visible body's vertices in the light's view space; with z > 0 of a positional
/// light
/// @return mapFromAcross, which takes the body into [-1, 1]^2 and touches all four sides, with
/// w > 0 over the body and a positive determinant. Uniform for a parallel camera, for light along the
/// view, for a light on the camera's axis, and where the eye lies in the body (no nearest
/// distance); the identity without vertices.
glm::dmat3 lispsmFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// How much of the perspective is used, in [-1, 1]: -1 the uniform map, 0 the optimum of LiSPSM, 1
/// the camera's own perspective.
///
/// Lloyd, Logarithmic Perspective Shadow Maps (thesis, 2007), section 5.2, and Lloyd et al., ACM
/// TOG 27(4), 2008: with theta half the field of view, gamma_a = theta/3, gamma_b = theta, gamma_c =
/// theta + 0.3 (90 - theta), eta_b = -0.2, eta_c = 0:
///   -1                                                              gamma < gamma_a
///   -1 + (eta_b + 1) (1 - cos(90 (gamma - gamma_a) / (gamma_b - gamma_a)))  up to gamma_b
///   eta_b + (eta_c - eta_b) sin(90 (gamma - gamma_b) / (gamma_c - gamma_b)) up to gamma_c
///   eta_c                                                           beyond
/// (The thesis prints 0 and 1 + cos for the first two, which would jump; these join.)
///
/// @param gammaDegrees the angle between light and view, in [0, 180]; taken modulo their direction
/// @param thetaDegrees half the field of view, in [0, 90)
double lispsmEta(double gammaDegrees, double thetaDegrees);

/// The warp's near distance in units of the depth that it warps; infinite for eta = -1.
///
/// Lloyd 2007, section 5.1.2.2, with alpha = farthest / nearest distance from the eye (> 1):
/// (1 + sqrt(alpha) - eta (alpha - 1)) / ((alpha - 1) (eta + 1)) for eta <= 0, and
/// 1 / ((sqrt(alpha) - 1) (eta sqrt(alpha) + 1)) for eta >= 0. For eta = 0 this is the optimum of
/// Wimmer et al. 2004, n + sqrt(f n) over f - n.
double lispsmNear(double alpha, double eta);

} // namespace gnomon

#endif
