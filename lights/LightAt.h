#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// The light that shines from one point of an area light, for maps of what that point sees.
///
/// Only the centre says what the light reaches, so that this one reaches all of it: fitLightViews()
/// then covers every caster that may be in the way of a receiver in the centre's cone or box.
/// - A spot's cone is wide enough to hold, from each point of the light, what the centre's cone
///   holds of the scene. It is the same at all points, so that their views are laid out alike: as a
///   cube where the light is large beside its distance from the receivers.
/// - A box stands along the point's rays, around all of those that end in the centre's box. Casters
///   count behind the centre's near face, which is not this box's (nearFaceCentred).
///
/// @param light with an area
/// @param offset of the point from the light's centre, as LightArea measures it
ShadowLight lightAt(const ShadowLight& light, const glm::dvec3& offset, const ViewFitting& fitting);

} // namespace gnomon
