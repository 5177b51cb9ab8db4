#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// What a texture shows beyond [0, 1].
enum class TextureWrap
{
  ClampToEdge,
  Repeat,
  MirroredRepeat,
  ClampToBorder
};

/// Where a texture leaves something of a surface: VTK draws no fragment whose alpha is 0. All of a
/// texture that shadows need. It never changes once made, so that surfaces may share it.
///
/// Filtered alpha is 0 only where every texel with a weight above 0 has alpha 0. So an interpolated
/// texture's holes are smaller than its empty texels, by half a texel all round. Mipmaps are left
/// out: which level VTK reads depends on how far away the camera is, and a shadow cannot; the mask
/// is that of the finest level.
struct CutoutMask
{
  int width = 0;  ///< texels
  int height = 0; ///< texels
  /// Row by row from texture coordinate v = 0: 255 where alpha is above 0, else 0.
  std::vector<std::uint8_t> texels;
  TextureWrap wrap = TextureWrap::Repeat; ///< in both directions
  bool interpolated = false;              ///< bilinearly; else the nearest texel counts
  bool borderDrawn = false;               ///< ClampToBorder: whether the border has alpha above 0

  /// Whether something is drawn at these texture coordinates, as OpenGL would filter the texels
  /// (core profile 4.5, section 8.14), but with weights that are not rounded. Any coordinates have
  /// an answer, NaN too.
  bool isDrawn(const glm::vec2& textureCoordinates) const;

  bool operator==(const CutoutMask& other) const
  {
    return this->width == other.width && this->height == other.height && this->wrap == other.wrap &&
      this->interpolated == other.interpolated && this->borderDrawn == other.borderDrawn &&
      this->texels == other.texels;
  }

  std::size_t bytes() const { return sizeof(CutoutMask) + this->texels.capacity(); }
};

} // namespace gnomon
