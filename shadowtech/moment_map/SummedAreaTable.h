#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/glm.hpp>

#include <cstddef>
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
  void allocate(int channels, int sizeTexels, int layers);
  /// Set the units of all later sums.
  /// @param largest power of two that no texel exceeds in size
  /// @param widestTexels longest side of any rectangle
  void setUnits(const glm::vec4& largest, double widestTexels);
  /// Fill a layer with the sums of a float map's layer. This changes texture unit 0 and the
  /// program.
  void sum(GLuint map, int mapLayer, int layer, ShaderLibrary& shaders);
  void release() { this->table_.reset(); }

  GLuint texture() const { return this->table_.name(); }
  std::size_t bytes() const { return this->table_.bytes(); }

  /// Return the uniforms of summed_area.glsl.
  /// @param empty the value outside a layer
  std::vector<Uniform> uniforms(const glm::vec4& empty) const;

private:
  SizedTexture table_;
  glm::vec4 unitsOfOne_{ 1.0f }; ///< powers of two
};

} // namespace gnomon
