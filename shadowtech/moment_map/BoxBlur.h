#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

class ShaderLibrary;

/// Replaces the texels of a map by their means over a square box, rows first, then columns. The
/// cost does not depend on the box's width (box_blur.comp.glsl).
///
/// The box of texel i begins at i - width / 2: around the texel for an odd width, around the
/// texel's lower corner for an even one. Outside of a layer there is nothing but empty texels.
class BoxBlur
{
public:
  /// @param format GL_RG32F or GL_RGBA32F
  /// @throws TextureMemoryError
  void allocate(const TexelFormat& format, int sizeTexels);
  /// Of what allocate() was given; every layer on its own.
  void apply(
    GLuint map, int layers, int widthTexels, const glm::vec4& empty, ShaderLibrary& shaders);
  void release();
  std::size_t bytes() const;

private:
  GlTexture rows_; ///< a layer whose rows are done
  TexelFormat format_{};
  int sizeTexels_ = 0;
};

} // namespace gnomon
