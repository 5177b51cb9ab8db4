#include "shadowtech/moment_map/SummedAreaTable.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon
{
namespace
{

constexpr int linesPerGroup =
  16; // as in sum_area.comp.glsl; lines are few, and must use all processors

TexelFormat sumsFormat(int channels)
{
  return channels == 2 ? TexelFormat{ GL_RG32UI, GL_RG_INTEGER, 2, GL_UNSIGNED_INT }
                       : TexelFormat{ GL_RGBA32UI, GL_RGBA_INTEGER, 4, GL_UNSIGNED_INT };
}

} // namespace

//------------------------------------------------------------------------------
void SummedAreaTable::allocate(int channels, int sizeTexels, int layers)
{
  this->table_.allocateMap(sumsFormat(channels), sizeTexels, layers);
}

//------------------------------------------------------------------------------
void SummedAreaTable::setUnits(const glm::vec4& largest, double widestTexels)
{
  // The shader clips rectangles to the layer, and reads up to two texels more along an axis.
  const double side = std::min(widestTexels + 2.0, static_cast<double>(this->table_.width()));
  for (int i = 0; i < 4; ++i)
  {
    // Powers of two keep a float's digits. A little of the integers' range is left for rounding.
    const double most =
      0.999 * std::ldexp(1.0, 31) / (static_cast<double>(largest[i]) * side * side);
    this->unitsOfOne_[i] = static_cast<float>(std::exp2(std::floor(std::log2(most))));
  }
}

//------------------------------------------------------------------------------
void SummedAreaTable::sum(GLuint map, int mapLayer, int layer, ShaderLibrary& shaders)
{
  const TexelFormat& format = this->table_.format();
  const std::string layout = format.channels == 2 ? "rg32ui" : "rgba32ui";
  const std::string source = ShaderLibrary::source("shadowtech/moment_map/sum_area.comp.glsl");
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, map);
  glBindImageTexture(
    0, this->table_.name(), 0, GL_FALSE, layer, GL_READ_WRITE, format.internalFormat);
  for (const char* lines : { "ROWS", "COLUMNS" })
  {
    const GLuint program =
      shaders.program({ { GL_COMPUTE_SHADER, source } }, { lines, "FORMAT " + layout });
    glUseProgram(program);
    ShaderLibrary::setUniform(program, { "source", 0 });
    ShaderLibrary::setUniform(program, { "layer", mapLayer });
    ShaderLibrary::setUniform(program, { "unitsOfOne", this->unitsOfOne_ });
    glDispatchCompute(
      static_cast<GLuint>((this->table_.width() + linesPerGroup - 1) / linesPerGroup), 1, 1);
    // Columns read the rows' output, and lookups read that.
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
  glBindImageTexture(0, 0, 0, GL_FALSE, 0, GL_READ_WRITE, format.internalFormat);
}

//------------------------------------------------------------------------------
std::vector<Uniform> SummedAreaTable::uniforms(const glm::vec4& empty) const
{
  return { { "momentTable_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->table_.name() } },
    { "tableUnits_LIGHT", this->unitsOfOne_ }, { "emptyMoments_LIGHT", empty } };
}

} // namespace gnomon
