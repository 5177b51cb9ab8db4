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

/// Where visibility is most wrong: the square with the greatest sum of squared differences, of the
/// ones that lie half a side apart.
/// @param differences of each pixel, row by row
/// @param side of the square, in pixels; a smaller picture has a smaller one
/// @return nothing where no pixel differs
std::optional<Place> worstPlace(
  const std::vector<float>& differences, int width, int height, int side);

/// A picture made smaller by a whole number, so that its sides have at most so many pixels.
Picture reduced(const Picture& picture, int mostPixels);

/// A place of a picture, whose pixels are squares of `pixelSide`.
Picture enlarged(const Picture& picture, const Place& place, int pixelSide);

} // namespace gnomon::tool
