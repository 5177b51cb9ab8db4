#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return the light without area that shines from one point of an area light. Techniques bake a map
/// of that point's view from it.
///
/// The area light's reach is the cone or box of its centre. The returned light reaches all of it,
/// so fitLightViews() covers every caster that may block a receiver there.
/// - A spot's cone is wide enough to hold, from each point of the light, the scene's part in the
///   centre's cone. It is the same at all points, so their views have the same layout. That is a
///   cube if the light is large relative to its distance from the receivers.
/// - A box lies along the point's rays, around all rays that end in the centre's box. Casters count
///   only behind the near face of the centre's box (nearFaceCentred), not of this box.
///
/// @param light with an area
/// @param offset of the point from the light's centre, in LightArea's units
ShadowLight lightAt(const ShadowLight& light, const glm::dvec3& offset, const ViewFitting& fitting);

} // namespace gnomon
