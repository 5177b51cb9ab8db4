#pragma once

#include <glm/glm.hpp>

namespace gnomon
{

/// The projection from a light onto a plane, in homogeneous coordinates: M = (P.L) I - L P^T for a
/// plane P = (n, d) of the points with n.p + d = 0, and a light L = (position, 1) or (direction, 0)
/// (Blinn, "Me and my (fake) shadow", 1988). P.(M v) = 0 for every v, and M v lies on the line
/// through L and v.
///
/// With P turned so that P.L > 0, the image of a point v has w = P.L - (P.v) L.w: positive for what
/// is nearer to the plane than the light. Where w <= 0 the point lies beside or beyond the light
/// and casts nothing on the plane; its image would be an anti-shadow. Nor does what has P.v <= 0
/// cast any. A light in the plane (P.L = 0) has the image of all points in itself.
///
/// @param plane (n, d), of any length
/// @param light in the plane's space, (position, 1) or (direction towards the light, 0)
inline glm::dmat4 planarProjection(const glm::dvec4& plane, const glm::dvec4& light)
{
  return glm::dmat4(glm::dot(plane, light)) - glm::outerProduct(light, plane);
}

} // namespace gnomon
