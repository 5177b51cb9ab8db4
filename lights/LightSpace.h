#pragma once

#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// Return the rigid transformation to a light's own space from centred world coordinates (world
/// coordinates less `centreWorld`).
///
/// z grows along directionWorld. A point light has no direction, so its axes are the world's. The
/// origin is the light's position, or the middle of its box's near face. For a directional light
/// without a box it is the centre. The x axis lies along a box's width, y along its height.
glm::dmat4 lightFromCentred(const ShadowLight& light, const glm::dvec3& centreWorld);

/// Return the plane (n, d) of a box's near face, in centred coordinates. Points p behind it along
/// the light have n.p + d > 0.
glm::dvec4 nearFaceCentred(const ShadowLight& light, const glm::dvec3& centreWorld);

/// Return the world axis that is least aligned with a direction.
glm::dvec3 axisAcross(const glm::dvec3& direction);

/// The number of faces of the cube around a light. Each face sees the directions with one longest
/// axis: +x, -x, +y, -y, +z, -z of light space, in this order.
constexpr int cubeFaces = 6;

/// Return the face that sees a point of light space. Ties go to x before y before z, and to plus.
/// light_views.glsl has its twin.
int cubeFaceOf(const glm::dvec3& positionLight);

/// Return the rotation from light space to a face's space, in which the face's axis is z.
glm::dmat3 cubeFaceFromLight(int face);

} // namespace gnomon
