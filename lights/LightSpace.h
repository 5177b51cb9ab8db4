#pragma once

#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// A light's own space, as a rigid transformation from centred world coordinates (world coordinates
/// less `centreWorld`).
///
/// z grows along directionWorld; of a point light, which has none, all axes are the world's. The
/// origin is the light's position or the middle of its box's near face; of a directional light
/// without a box, the centre. The x axis of a box lies along its width, y along its height.
glm::dmat4 lightFromCentred(const ShadowLight& light, const glm::dvec3& centreWorld);

/// The plane (n, d) of a box's near face, centred: what lies behind it along the light has n.p + d
/// > 0.
glm::dvec4 nearFaceCentred(const ShadowLight& light, const glm::dvec3& centreWorld);

/// The world axis that is least aligned with this direction.
glm::dvec3 axisAcross(const glm::dvec3& direction);

/// The faces of the cube around a light, each of which sees the directions of which one axis is the
/// longest: +x, -x, +y, -y, +z, -z of light space.
constexpr int cubeFaces = 6;

/// The face that sees a point of light space: x before y before z, plus before minus, where they
/// are equally long. light_views.glsl has its twin.
int cubeFaceOf(const glm::dvec3& positionLight);

/// From light space to a face's: the face's own axis becomes z. A rotation.
glm::dmat3 cubeFaceFromLight(int face);

} // namespace gnomon
