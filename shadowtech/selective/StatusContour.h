#pragma once

#include <cstdint>
#include <vector>

namespace gnomon
{

/// A pixel's status by the shadow map; as bits, of which an area may have several.
enum class PixelStatus : std::uint8_t
{
  None = 0, ///< nothing is there that a shadow could fall on
  Lit = 1,
  Shadow = 2
};

/// The contour between light and shadow on the screen: the pixels that have pixels of both statuses
/// within some distance, in rows and in columns. So it is twice as wide as that across a border,
/// half of it lit. (D. L. Moderno, Shadow Mapping and Ray-Tracing, 3.1.2: a contour of 2 pixels,
/// dilated once and twice.)
///
/// @param statuses row by row, width * height
/// @param radiusPixels >= 1
/// @return 1 for pixels of the contour, which have a status, else 0
std::vector<std::uint8_t> contourOf(
  const std::vector<PixelStatus>& statuses, int width, int height, int radiusPixels);

} // namespace gnomon
