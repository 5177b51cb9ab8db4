#pragma once

#include "lights/LightViews.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return the Jacobian d texel / d across of a homography at a point across the light.
/// @param texelFromAcross positive w at the point, positive determinant
glm::dmat2 texelJacobian(const glm::dmat3& texelFromAcross, const glm::dvec2& across);

/// Return the limit of the stretch on the map of a kernel that is even across the light
/// (kernel_shape.glsl), at most 4. A kernel of n texels reads n + 1 texels, as its filter is
/// bilinear. The limit leaves 2 texels on the narrow side, as a bilinear filter of one texel has.
/// Texels may be 16 times as long as wide before the limit of 4 shows; for the default kernel of 3
/// texels, 4 times.
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
