#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Return the warp of light space perspective shadow maps: a perspective across the light's rays,
/// whose texels grow with distance from the camera (Wimmer, Scherzer, Purgathofer 2004, section 3).
/// The map's y axis lies along the direction of view as the light sees it, with near points at the
/// bottom.
///
/// For parallel rays, the warp's near distance is the published optimum for the nearest and
/// farthest visible distance (lispsmOptimum). It falls off to the uniform map as light and view
/// become parallel or opposite (fallOff). For rays from a position, the angle between light and
/// view varies with place, as do texels. There leastAliasingNear() searches for the optimum.
///
/// @param bodyView the visible body's vertices in the light's view space, with z > 0 for a
/// positional light
/// @return mapFromAcross, with w > 0 over the body and a positive determinant; the body's image
/// lies in [-1, 1]^2 and touches all four sides. It is exactly the uniform map (uniformFromAcross)
/// for a parallel camera, light along the view, a light on the camera's axis, a body that reaches
/// the eye's plane, and a warp that would gain little (warpedOrUniform). Without vertices it is the
/// identity.
glm::dmat3 lispsmFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// Return the candidate warps of a view that is fitted to receivers
/// (shadowtech/fitting/ReceiverFit.h). The uniform map is first. Perspectives follow, with near
/// distances that grow by equal factors from leastNearOfSeries to greatestNearOfSeries, in units of
/// the warped depth. All fit the body as lispsmFromAcross() does. The uniform map is alone if
/// lispsmFromAcross() allows no perspective.
///
/// The published optimum minimises the worst texel, and depends on the nearest and farthest point
/// only. If most of the view is far away, as in a view along the ground, it spends the map on the
/// few nearest points.
std::vector<glm::dmat3> lispsmSeries(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

constexpr double leastNearOfSeries = 0.01;
constexpr double greatestNearOfSeries = 10.0;
constexpr int stepsOfSeries = 18; ///< by a factor of 1.47, within which the optimum is flat

/// The largest ratio of a texel's side under the series to its side under the uniform map: (1 + n)
/// / n, at the far end of the strongest perspective.
constexpr double coarsestOfSeries = (1.0 + leastNearOfSeries) / leastNearOfSeries;

/// Return the optimal near distance of the warp in units of the warped depth, (n + sqrt(f n)) / (f
/// - n), for light across the view (Wimmer et al. 2004, section 4).
/// @param alpha ratio f / n of the farthest to the nearest distance from the eye, > 1
double lispsmOptimum(double alpha);

} // namespace gnomon
