#include "lights/HashedPoints.h"

#include "lights/ReducedMd5.h"

namespace gnomon
{

glm::uvec3 HashedPoints::point(int i, const SamplePixel& pixel) const
{
  // A hash has a word for each of four points.
  const auto number = static_cast<std::uint32_t>(i);
  const auto word = static_cast<glm::length_t>(number % 4u);
  const glm::uvec4 hash = reducedMd5({ pixel.bits.x, pixel.bits.y, number / 4u, 0u }, this->key_);
  const std::uint32_t across = hash[word];
  const std::uint32_t along = this->solid_ ? reducedMd5(hash, this->key_)[word] : 0u;

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
