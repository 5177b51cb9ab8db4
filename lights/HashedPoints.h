#pragma once

#include "lights/SamplePixel.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// Random points of the unit square or cube, each by itself: of the pixel and its number, by
/// reducedMd5(), half a word for each coordinate of the square (Curtis 2009, section 3.1).
///
/// A cube's third coordinates are hashes of those hashes. Those of seeds that differ in a bit would
/// not do: 16 steps leave them too much alike, so that the second and the third coordinate depended
/// on each other with every other key.
class HashedPoints
{
public:
  /// @param dimensions 2 or 3
  /// @param side points lie one in each cell of a grid of side x side, row by row; 1: anywhere
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

  /// Point `i` of a pixel: fractions of 2^32; of the square, the third one is 0.
  glm::uvec3 point(int i, const SamplePixel& pixel) const;

private:
  bool solid_;
  std::uint32_t side_;
  std::uint32_t key_;
};

} // namespace gnomon
