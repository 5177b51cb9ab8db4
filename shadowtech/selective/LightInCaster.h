#pragma once

#include "lights/LightArea.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return true if a positional light lies in a caster: on one of its triangles, to within rounding.
///
/// Shadow rays to this light end on the triangle. Its maps see the triangle edge-on, and so miss
/// it. An area lies in a triangle if it is flat, coplanar with it, and no farther than its radius.
/// A light that crosses a caster does not lie in it, as either side sees the caster.
/// @param positionCentred the light's centre
/// @param area around it, in world units; null for a point light
bool liesInCaster(
  const glm::dvec3& positionCentred, const LightArea* area, const Occluders& occluders);

} // namespace gnomon
