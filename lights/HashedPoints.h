#ifndef gnomon_lights_HashedPoints_h
#define gnomon_lights_HashedPoints_h

#include "lights/SamplePixel.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace gnomon
{

/// Random points of the unit cube, each by itself: of the pixel and its number, by reducedMd5(), half a word for each
/// coordinate (Curtis 2009, section 3.1).
class HashedPoints
{
public:
  /// @param side points lie one in each cell of a grid of side x side, row by row; 1: anywhere
  HashedPoints(int side, std::uint32_t key)
    : side_(static_cast<std::uint32_t>(side))
    , key_(key)
  {
  }

  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const
  {
    SamplePixel pixel;
    pixel.bits = { column, row, 0u };
    return pixel;
  }

  /// Point `i` of a pixel: fractions of 2^32.
  glm::uvec3 point(int i, const SamplePixel& pixel) const;

private:
  std::uint32_t side_;
  std::uint32_t key_;
};

} // namespace gnomon

#endif
