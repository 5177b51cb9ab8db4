#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>

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
    GLuint map, int layers, int widthTexels, const glm::vec4& empty, ShaderLibrary& shaders)
  {
    const std::string format = this->rows_.format().channels == 1 ? "r32f"
      : this->rows_.format().channels == 2                        ? "rg32f"
                                                                  : "rgba32f";
    const GLuint program = shaders.program(
      { { GL_COMPUTE_SHADER, ShaderLibrary::source("shadowtech/moment_map/box_blur.comp.glsl") } },
      { "BLUR_TEXELS " + std::to_string(widthTexels), "FORMAT " + format });
    glUseProgram(program);
    ShaderLibrary::setUniform(program, { "source", 0 });
    ShaderLibrary::setUniform(program, { "empty", empty });
    glActiveTexture(GL_TEXTURE0);
    const auto pass =
      [&](GLuint source, int sourceLayer, GLuint target, int targetLayer, const glm::ivec2& axis)
    {
      glBindTexture(GL_TEXTURE_2D_ARRAY, source);
      glBindImageTexture(
        0, target, 0, GL_FALSE, targetLayer, GL_WRITE_ONLY, this->rows_.format().internalFormat);
      ShaderLibrary::setUniform(program, { "layer", sourceLayer });
      ShaderLibrary::setUniform(program, { "axis", axis });
      glDispatchCompute(ceilDivide(this->rows_.width(), texelsPerGroup),
        ceilDivide(this->rows_.width(), widthTexels), 1);
      // The next pass reads this one's texels, and writes where this one read.
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    };
    for (int layer = 0; layer < layers; ++layer)
    {
      pass(map, layer, this->rows_.name(), 0, { 1, 0 });
      pass(this->rows_.name(), 0, map, layer, { 0, 1 });
    }
    glBindImageTexture(0, 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, this->rows_.format().internalFormat);
  }

  void release() { this->rows_.reset(); }
  std::size_t bytes() const { return this->rows_.bytes(); }

private:
  static constexpr int texelsPerGroup = 64; // as in box_blur.comp.glsl

  static GLuint ceilDivide(int dividend, int divisor)
  {
    return static_cast<GLuint>((dividend + divisor - 1) / divisor);
  }

  SizedTexture rows_; ///< a layer after the pass along rows
};

} // namespace gnomon
