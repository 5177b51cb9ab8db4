#pragma once

#include <cstdint>
#include <vector>

namespace gnomon
{

/// A pixel's status on the shadow map, as bits that an area combines.
enum class PixelStatus : std::uint8_t
{
  None = 0, ///< nothing that receives shadows
  Lit = 1,
  Shadow = 2
};

/// Return the contour between light and shadow on the screen: pixels with both statuses within some
/// distance, in rows and in columns. Across a border it is twice as wide as that distance, half of
/// it lit. D. L. Moderno (Shadow Mapping and Ray-Tracing, 3.1.2) dilates a contour of 2 pixels once
/// and twice.
///
/// @param statuses row by row, width * height
/// @param radiusPixels the distance, >= 1
/// @return 1 for pixels of the contour, which have a status, else 0
std::vector<std::uint8_t> contourOf(
  const std::vector<PixelStatus>& statuses, int width, int height, int radiusPixels);

} // namespace gnomon
