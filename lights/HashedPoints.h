#pragma once

#include "lights/SamplePixel.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// Independent random points of the unit square or cube. reducedMd5() hashes the pixel and the
/// point's number; each coordinate of the square is half a word of the hash (Curtis 2009, section
/// 3.1).
///
/// A cube's third coordinates are hashes of those hashes. Hashing seeds that differ in one bit
/// would not do. After 16 steps they are still too similar: with every other key, the second and
/// third coordinates would depend on each other.
class HashedPoints
{
public:
  /// @param dimensions 2 or 3
  /// @param side one point lies in each cell of a grid of side x side, row by row; 1: anywhere
  HashedPoints(int dimensions, int side, std::uint32_t key)
    : solid_(dimensions == 3)
    , side_(static_cast<std::uint32_t>(side))
    , key_(key)
  {
  }

  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const
  {
    SamplePixel pixel;
    pixel.bits = { column, row, 0u };
    return pixel;
  }

  /// Return point `i` of a pixel, as fractions of 2^32. The third coordinate is 0 for the square.
  glm::uvec3 point(int i, const SamplePixel& pixel) const;

private:
  bool solid_;
  std::uint32_t side_;
  std::uint32_t key_;
};

} // namespace gnomon
