#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

class ShaderLibrary;

/// Replaces the texels of a map by their means over a square box, first along rows, then along
/// columns. The cost does not depend on the box's width (box_blur.comp.glsl).
///
/// The box of texel i begins at i - width / 2. So it is centred on the texel for an odd width, and
/// on the texel's lower corner for an even one. Texels outside a layer are empty.
class BoxBlur
{
public:
  /// Allocate memory for a layer.
  /// @param format GL_RG32F or GL_RGBA32F
  /// @param sizeTexels side of the map
  /// @throws TextureMemoryError without enough memory
  void allocate(const TexelFormat& format, int sizeTexels)
  {
    this->rows_.allocateMap(format, sizeTexels, 1);
  }
  /// Blur all layers of a map with the allocated format and size, each separately.
  void apply(
    GLuint map, int layers, int widthTexels, const glm::vec4& empty, ShaderLibrary& shaders);
  void release() { this->rows_.reset(); }
  std::size_t bytes() const { return this->rows_.bytes(); }

private:
  SizedTexture rows_; ///< a layer after the pass along rows
};

} // namespace gnomon
