#pragma once

#include "ImageFile.h"

#include <optional>
#include <vector>

namespace gnomon::tool
{

/// A square part of a picture, in pixels from its upper left corner.
struct Place
{
  int left = 0;
  int top = 0;
  int side = 0;

  bool operator==(const Place& other) const
  {
    return this->left == other.left && this->top == other.top && this->side == other.side;
  }
};

/// Return the place with the largest error: the square with the greatest sum of squared
/// differences, among squares half a side apart.
/// @param differences each pixel's difference, row by row
/// @param side the square's side in pixels; smaller in a smaller picture
/// @return nothing if no pixel differs
std::optional<Place> worstPlace(
  const std::vector<float>& differences, int width, int height, int side);

/// Return a picture reduced by an integer factor, with sides of at most `mostPixels`.
Picture reduced(const Picture& picture, int mostPixels);

/// Return a place of a picture with pixels enlarged to squares of `pixelSide`.
Picture enlarged(const Picture& picture, const Place& place, int pixelSide);

} // namespace gnomon::tool
