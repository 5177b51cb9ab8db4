#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// Where a picture has shadows, in squares of 16 x 16 pixels: small enough to leave out most of
/// what is lit, large enough to be few. Neighbours in a row that are of one kind are one rectangle.
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
  std::vector<Rectangle> inPart; ///< some of their pixels are not lit, or not all
  std::vector<Rectangle> whole;  ///< all of their pixels are in shadow
  bool mixes = false;            ///< some pixels are between light and shadow
};

/// @param visibility of a picture's pixels, row by row: in shadow where it is 0, lit
/// where it is 1
ShadowedTiles findShadowedTiles(const std::vector<float>& visibility, const glm::ivec2& size);

} // namespace gnomon
