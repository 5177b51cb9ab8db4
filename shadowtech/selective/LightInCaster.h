#pragma once

#include "lights/LightArea.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return whether a positional light lies in a caster: on one of its triangles, to within rounding.
///
/// The shadow rays to such a light end on that triangle, but its maps see the triangle edge-on, and
/// so not at all. An area lies in a triangle if it is flat, coplanar with it and as near to it as
/// its radius. A light that crosses a caster does not lie in it: either side sees the caster.
///
/// @param positionCentred the light's centre
/// @param area around it, in world units; null: the light is a point
bool liesInCaster(
  const glm::dvec3& positionCentred, const LightArea* area, const Occluders& occluders);

} // namespace gnomon
