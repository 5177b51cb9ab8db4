#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon
{

class ShaderLibrary;

/// A summed-area table: sums of all texels up to each texel of a map, four of which give the sum
/// over any rectangle. Sources: Crow 1984, "Summed-area tables for texture mapping"; Lauritzen
/// 2007, GPU Gems 3, chapter 8, for moments.
///
/// **Integers that wrap.** The sum over a small rectangle is a difference of sums over the whole
/// map, which leaves floats few digits. So texels are 32-bit fixed-point numbers here. Their unit
/// lets a sum over the widest rectangle just fit. Larger sums wrap, and their differences remain
/// exact.
///
/// **The unit loses no digits.** A texel's rounding remainder is added to the next one in its row.
/// So the sum over a part of a row, of any length, is off by less than one unit. Rows begin
/// with different remainders, which cancel over a rectangle.
class SummedAreaTable
{
public:
  /// Allocate the table.
  /// @param channels 2 or 4
  /// @param sizeTexels side of the map
  /// @throws TextureMemoryError without enough memory
  void allocate(int channels, int sizeTexels, int layers)
  {
    this->table_.allocateMap(sumsFormat(channels), sizeTexels, layers);
  }

  /// Set the units of all later sums.
  /// @param largest power of two that no texel exceeds in size
  /// @param widestTexels longest side of any rectangle
  void setUnits(const glm::vec4& largest, double widestTexels)
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

  /// Fill a layer with the sums of a float map's layer. This changes texture unit 0 and the
  /// program.
  void sum(GLuint map, int mapLayer, int layer, ShaderLibrary& shaders)
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

  void release() { this->table_.reset(); }

  GLuint texture() const { return this->table_.name(); }
  std::size_t bytes() const { return this->table_.bytes(); }

  /// Return the uniforms of summed_area.glsl.
  /// @param empty the value outside a layer
  std::vector<Uniform> uniforms(const glm::vec4& empty) const
  {
    return { { "momentTable_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->table_.name() } },
      { "tableUnits_LIGHT", this->unitsOfOne_ }, { "emptyMoments_LIGHT", empty } };
  }

private:
  static constexpr int linesPerGroup =
    16; // as in sum_area.comp.glsl; lines are few, and must use all processors

  static TexelFormat sumsFormat(int channels)
  {
    return channels == 2 ? TexelFormat{ GL_RG32UI, GL_RG_INTEGER, 2, GL_UNSIGNED_INT }
                         : TexelFormat{ GL_RGBA32UI, GL_RGBA_INTEGER, 4, GL_UNSIGNED_INT };
  }

  SizedTexture table_;
  glm::vec4 unitsOfOne_{ 1.0f }; ///< powers of two
};

} // namespace gnomon
