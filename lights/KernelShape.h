#pragma once

#include "lights/LightViews.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// How a map's texels lie at a point across the light: d texel / d across of a homography.
/// @param texelFromAcross positive w at the point, positive determinant
glm::dmat2 texelJacobian(const glm::dmat3& texelFromAcross, const glm::dvec2& across);

/// The shape of a kernel that is even across the light and keeps its area in texels: J / sqrt(det
/// J), whose singular values are the stretch s and 1 / s. Where s is larger than the limit, the
/// matrix that stretches by the limit along the same axes.
///
/// A matrix is the sum of a turn and of a mirroring, both scaled: by half the sum and half the
/// difference of the singular values. The limit changes those two numbers alone.
///
/// Degenerate case: a determinant of 0 stretches without end, and so by the limit.
/// @param jacobian not 0, determinant not negative
/// @param largestStretch >= 1
glm::dmat2 evenShape(const glm::dmat2& jacobian, double largestStretch);

/// The limit of the stretch of a kernel that is so many texels wide: so that its narrow side is
/// still that of the bilinear filter of one texel (n + 1 texels, of which stretching leaves 2), and
/// 4 at most. A texel may be 16 times as long across the light as it is wide until the latter is
/// felt, 4 times for the default kernel of 3 texels.
double largestStretch(int kernelTexels);

/// The most texels to a unit across the light in any of the views; 0 without views.
double mostTexelsAcross(const LightViews& views, int sizeTexels);

/// How far from a point's place across the light the rays to an area light pass the casters, at
/// most: of the casters that come first and the farthest point that receives. Of a caster at
/// distance z from the light and a receiver at distance r, that is the light's radius times 1 / z -
/// 1 / r, of a directional light times r - z; and more where a cube's face sees the light at a
/// slant.
double reachOfArea(const LightArea& area, const LightViews& views, const Bounds& castersCentred,
  const Bounds& receiversCentred);

/// Of a positional light's view: the length of the longest ray on the map that reaches distance 1.
double longestRay(const LightView& view);

} // namespace gnomon
