#include "shadowtech/moment_map/BoxBlur.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <string>

namespace gnomon
{
namespace
{

constexpr int texelsPerGroup = 64; // as in box_blur.comp.glsl

GLuint ceilDivide(int dividend, int divisor)
{
  return static_cast<GLuint>((dividend + divisor - 1) / divisor);
}

} // namespace

//------------------------------------------------------------------------------
void BoxBlur::apply(
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

} // namespace gnomon
