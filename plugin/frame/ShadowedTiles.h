#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The tiles of a picture with shadows, in squares of 16 x 16 pixels. Smaller tiles would be too
/// many; larger ones would include too many lit pixels. Neighbours of one kind in a row are merged
/// into one rectangle.
struct ShadowedTiles
{
  /// In pixels; the upper corner is the first pixel beyond.
  struct Rectangle
  {
    glm::ivec2 lower, upper;

    bool operator==(const Rectangle& other) const
    {
      return this->lower == other.lower && this->upper == other.upper;
    }
  };
  std::vector<Rectangle> inPart; ///< with pixels that are not fully lit, and others
  std::vector<Rectangle> whole;  ///< all pixels are in shadow
  bool mixes = false;            ///< some pixels are between light and shadow
};

/// Find the tiles with shadows.
/// @param visibility of a picture's pixels, row by row: 0 in shadow, 1 lit
ShadowedTiles findShadowedTiles(const std::vector<float>& visibility, const glm::ivec2& size);

} // namespace gnomon
