#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// How a surface lets light through: the colour and opacity with which VTK draws it.
///
/// A crossing leaves 1 - a of the light, where a is the opacity. A coloured sheet leaves
/// 1 - a (1 - c) of each channel, where c is the colour.
struct Sheet
{
  bool isColoured = false;
  std::uint32_t prop = 0;   ///< number of the view prop; copies of a triangle within it count once
  glm::vec4 colour{ 1.0f }; ///< of the property: red, green, blue, opacity
  ///@{
  /// Mapped scalars, of the vertices or of the triangles; empty: none. Their colour replaces the
  /// property's, and their alpha multiplies its opacity.
  std::vector<glm::u8vec4> ofVertices, ofTriangles;
  ///@}

  bool operator==(const Sheet& other) const
  {
    return this->isColoured == other.isColoured && this->prop == other.prop &&
      this->colour == other.colour && this->ofVertices == other.ofVertices &&
      this->ofTriangles == other.ofTriangles;
  }
};

} // namespace gnomon
