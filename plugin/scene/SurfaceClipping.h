#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// Cut a surface's triangles at a mapper's clipping planes, since VTK draws no fragment on their
/// negative sides. The pieces of a triangle are consecutive and have its orientation. New vertices
/// are appended.
///
/// @param textureCoordinates one for each position, or none; those of new vertices are appended
/// @param planes (n, d) with n.x + d >= 0 on the side that stays, in the space of the positions
/// @param triangleOfDrawn the surface's table (Surface::triangleOfDrawn), which is updated: a cut
/// triangle leads to its first piece, which lies in the same plane, a removed one to noTriangle
void clipTriangles(const std::vector<glm::dvec4>& planes, std::vector<glm::vec3>& positions,
  std::vector<glm::vec2>& textureCoordinates, std::vector<glm::uvec3>& triangles,
  std::vector<std::uint32_t>& triangleOfDrawn);

} // namespace gnomon
