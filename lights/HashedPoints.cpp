#include "lights/HashedPoints.h"

#include "lights/ReducedMd5.h"

namespace gnomon
{

//------------------------------------------------------------------------------
glm::uvec3 HashedPoints::point(int i, const SamplePixel& pixel) const
{
  // A hash has a word for each of four points, and another one their third coordinates.
  const auto number = static_cast<std::uint32_t>(i);
  const auto word = static_cast<glm::length_t>(number % 4u);
  const glm::uvec4 seed(pixel.bits.x, pixel.bits.y, number / 4u, 0u);
  const std::uint32_t across = reducedMd5(seed, this->key_)[word];
  const std::uint32_t along = reducedMd5(seed + glm::uvec4(0u, 0u, 0u, 1u), this->key_)[word];

  // In 64 bits, so that a cell's border is where the grid has it.
  const auto inCell = [&](std::uint32_t cell, std::uint32_t fraction)
  {
    const std::uint64_t place = (std::uint64_t(cell) << 32) + (std::uint64_t(fraction) << 16);
    return static_cast<std::uint32_t>(place / this->side_);
  };
  const std::uint32_t row = number / this->side_ % this->side_;
  return { inCell(number % this->side_, across & 0xffffu), inCell(row, across >> 16), along };
}

} // namespace gnomon
