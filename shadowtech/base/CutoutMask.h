#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// How a texture continues outside of [0, 1].
enum class TextureWrap
{
  ClampToEdge,
  Repeat,
  MirroredRepeat,
  ClampToBorder
};

/// Where a texture cuts holes into a surface: VTK draws no fragment whose alpha is 0. Shadows need
/// nothing else of a texture. A mask is immutable, so surfaces may share it.
///
/// Filtered alpha is 0 only where all texels with a weight above 0 have alpha 0. So the holes of an
/// interpolated texture are smaller than its empty texels, by half a texel all round. The mask is
/// that of the finest mipmap level: VTK chooses levels by the camera's distance, which a shadow
/// must not depend on.
struct CutoutMask
{
  int width = 0;  ///< texels
  int height = 0; ///< texels
  /// Row by row from texture coordinate v = 0: 255 where alpha is above 0, else 0. For translucent
  /// surfaces: alpha times 255, and at least 1 where it is above 0.
  std::vector<std::uint8_t> texels;
  TextureWrap wrap = TextureWrap::Repeat; ///< in both directions
  bool interpolated = false;              ///< bilinearly; else the nearest texel counts
  bool borderDrawn = false;               ///< ClampToBorder: the border has alpha above 0

  /// True if the texture has alpha above 0 at these coordinates. The filter is OpenGL's (core
  /// profile 4.5, section 8.14), but with unrounded weights. All coordinates are allowed, NaN
  /// included.
  bool isDrawn(const glm::vec2& textureCoordinates) const;

  /// Return the filtered texel at these coordinates, from 0 to 1. Without rounding the weights, as
  /// in isDrawn().
  double alphaAt(const glm::vec2& textureCoordinates) const;

  bool operator==(const CutoutMask& other) const
  {
    return this->width == other.width && this->height == other.height && this->wrap == other.wrap &&
      this->interpolated == other.interpolated && this->borderDrawn == other.borderDrawn &&
      this->texels == other.texels;
  }

  std::size_t bytes() const { return sizeof(CutoutMask) + this->texels.capacity(); }
};

} // namespace gnomon
