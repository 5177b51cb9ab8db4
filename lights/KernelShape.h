#pragma once

#include "lights/LightViews.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return the Jacobian d texel / d across of a homography at a point across the light.
/// @param texelFromAcross positive w at the point, positive determinant
glm::dmat2 texelJacobian(const glm::dmat3& texelFromAcross, const glm::dvec2& across);

/// Return the shape on the map of a kernel that is isotropic across the light and keeps its area in
/// texels. It is J / sqrt(det J), with singular values s (the stretch) and 1 / s. If s exceeds the
/// limit, the result stretches by the limit along the same axes.
///
/// A 2 x 2 matrix is the sum of a scaled rotation and a scaled reflection. Their scales are half
/// the sum and half the difference of the singular values. The limit changes these two numbers
/// only.
///
/// Degenerate case: a determinant of 0 means an infinite stretch, so the limit applies.
/// @param jacobian not 0, determinant not negative
/// @param largestStretch >= 1
glm::dmat2 evenShape(const glm::dmat2& jacobian, double largestStretch);

/// Return the limit of a kernel's stretch, at most 4. A kernel of n texels reads n + 1 texels with
/// its bilinear filter. The limit leaves 2 texels on the narrow side, as a bilinear filter of one
/// texel has. Texels may be 16 times as long as wide before the limit of 4 shows; for the default
/// kernel of 3 texels, 4 times.
double largestStretch(int kernelTexels);

/// Return the most texels per unit across the light over all views; 0 without views.
double mostTexelsAcross(const LightViews& views, int sizeTexels);

/// Return a bound on how far rays to an area light stray from a receiver's place across the light
/// where they pass casters. For a caster at distance z from the light and a receiver at distance r,
/// it is the light's radius times 1 / z - 1 / r. For directional lights it is the radius times r -
/// z. The bound takes the nearest caster and the farthest receiver, and is larger for cube faces,
/// which see the light at a slant.
double reachOfArea(const LightArea& area, const LightViews& views, const Bounds& castersCentred,
  const Bounds& receiversCentred);

/// Return the length of the longest ray on a positional light's map, up to distance 1 along the
/// view.
double longestRay(const LightView& view);

} // namespace gnomon
