#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

class ShaderLibrary;

/// The sums of all texels up to each of a map's texels, of which four give the sum over any
/// rectangle (Crow 1984, "Summed-area tables for texture mapping"; of moments: Lauritzen 2007, GPU
/// Gems 3, chapter 8).
///
/// **Integers that wrap.** A sum over the whole map leaves floats few digits for a small rectangle,
/// which is the difference of such sums. Here texels are fixed-point numbers of 32 bits, in units
/// that let a sum over the widest rectangle just fit; sums over more than that wrap, and their
/// differences are exact all the same.
///
/// **No digits are lost to the unit.** What rounding leaves of a texel is added to the next one in
/// its row, so that the sum over any part of a row is off by less than one unit, whatever its
/// length. Rows begin with different remainders, so that those of a rectangle's rows cancel.
class SummedAreaTable
{
public:
  /// @param channels 2 or 4
  /// @throws TextureMemoryError
  void allocate(int channels, int sizeTexels, int layers);
  /// States what the sums are counted in, from now on.
  /// @param largest a power of two that no texel's size exceeds
  /// @param widestTexels the longest side of any rectangle
  void setUnits(const glm::vec4& largest, double widestTexels);
  /// Fills a layer with the sums of a layer of floats. The texture unit 0 and the program are
  /// changed.
  void sum(GLuint map, int mapLayer, int layer, ShaderLibrary& shaders);
  void release();

  GLuint texture() const { return this->table_.name(); }
  std::size_t bytes() const;

  /// What summed_area.glsl reads.
  /// @param empty what there is outside of a layer
  std::vector<Uniform> uniforms(const glm::vec4& empty) const;

private:
  GlTexture table_;
  int channels_ = 0;
  int sizeTexels_ = 0;
  int layers_ = 0;
  glm::vec4 unitsOfOne_{ 1.0f }; ///< powers of two
};

} // namespace gnomon
