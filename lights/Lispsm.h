#pragma once

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
/// The warp's near distance, for parallel rays, is the published optimum between the nearest and
/// the farthest visible point (lispsmOptimum), and falls off to the uniform map as light and view
/// become parallel, either way (fallOff). Rays from a position see an angle between light and view,
/// and texels, that differ from place to place; the optimum is searched for there
/// (leastAliasingNear).
///
/// @param bodyView the visible body's vertices in the light's view space; with z > 0 of a
/// positional light
/// @return mapFromAcross, which takes the body into [-1, 1]^2 and touches all four sides, with
/// w > 0 over the body and a positive determinant. Exactly the uniform map (uniformFromAcross) for
/// a parallel camera, for light along the view, for a light on the camera's axis, where the body
/// reaches the eye's plane, and wherever a warp would hardly gain (warpedOrUniform); the identity
/// without vertices.
glm::dmat3 lispsmFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

/// Inputs of the choice of a warp, for a view that is fitted to receivers
/// (shadowtech/fitting/ReceiverFit.h): the uniform map first, then the perspectives with near
/// distances that grow by equal factors from leastNearOfSeries to greatestNearOfSeries, in units of
/// the depth that they warp. All of them take the body as lispsmFromAcross() does. Only the
/// uniform one where lispsmFromAcross() allows no perspective.
///
/// The published optimum is that of the worst texel, and knows the nearest and the farthest point
/// only. Where most of what is seen lies far away, as in a view along the ground, it spends the map
/// on the nearest points, of which there are few.
std::vector<glm::dmat3> lispsmSeries(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

constexpr double leastNearOfSeries = 0.01;
constexpr double greatestNearOfSeries = 10.0;
constexpr int stepsOfSeries = 18; ///< of a factor 1.47: between two of them the optimum is flat

/// How many times larger than under the uniform map a texel's sides can be under the series, at
/// most: at the far end of the strongest, (1 + n) / n.
constexpr double coarsestOfSeries = (1.0 + leastNearOfSeries) / leastNearOfSeries;

/// The optimum of the warp's near distance in units of the depth that it warps, n + sqrt(f n) over
/// f - n (Wimmer et al. 2004, section 4, for light across the view).
/// @param alpha the ratio f / n of the farthest to the nearest distance from the eye, > 1
double lispsmOptimum(double alpha);

} // namespace gnomon
