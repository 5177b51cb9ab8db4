#pragma once

#include <glm/glm.hpp>

namespace gnomon
{

/// Return the projection from a light onto a plane, in homogeneous coordinates: M = (P.L) I - L P^T
/// (Blinn, "Me and my (fake) shadow", 1988). P = (n, d) holds the points with n.p + d = 0; L is
/// (position, 1) or (direction, 0). P.(M v) = 0 for every v, and M v lies on the line through L and
/// v.
///
/// Let the sign of P give P.L > 0. Then the image of a point v has w = P.L - (P.v) L.w, positive
/// for points nearer to the plane than the light. A point with w <= 0 lies beside or beyond the
/// light and casts no shadow on the plane; its image would be an anti-shadow. Points with P.v <= 0
/// cast none either. For a light in the plane (P.L = 0), all images lie at the light.
///
/// @param plane (n, d), of any length
/// @param light in the plane's space, (position, 1) or (direction towards the light, 0)
inline glm::dmat4 planarProjection(const glm::dvec4& plane, const glm::dvec4& light)
{
  return glm::dmat4(glm::dot(plane, light)) - glm::outerProduct(light, plane);
}

} // namespace gnomon
