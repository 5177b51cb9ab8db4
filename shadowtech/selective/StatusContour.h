#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
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
inline std::vector<std::uint8_t> contourOf(
  const std::vector<PixelStatus>& statuses, int width, int height, int radiusPixels)
{
  const auto rowOf = [width](int y)
  { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width); };
  // Combine the statuses around each pixel in its row.
  std::vector<std::uint8_t> inRow(statuses.size());
  tbb::parallel_for(0, height,
    [&](int y)
    {
      const PixelStatus* const from = statuses.data() + rowOf(y);
      std::uint8_t* const to = inRow.data() + rowOf(y);
      for (int x = 0; x < width; ++x)
      {
        std::uint8_t found = 0;
        for (int k = std::max(x - radiusPixels, 0); k <= std::min(x + radiusPixels, width - 1); ++k)
        {
          found = static_cast<std::uint8_t>(found | static_cast<std::uint8_t>(from[k]));
        }
        to[x] = found;
      }
    });
  std::vector<std::uint8_t> contour(statuses.size());
  tbb::parallel_for(0, height,
    [&](int y)
    {
      std::uint8_t* const to = contour.data() + rowOf(y);
      for (int k = std::max(y - radiusPixels, 0); k <= std::min(y + radiusPixels, height - 1); ++k)
      {
        const std::uint8_t* const from = inRow.data() + rowOf(k);
        for (int x = 0; x < width; ++x)
        {
          to[x] = static_cast<std::uint8_t>(to[x] | from[x]);
        }
      }
      constexpr int both =
        static_cast<int>(PixelStatus::Lit) | static_cast<int>(PixelStatus::Shadow);
      const PixelStatus* const status = statuses.data() + rowOf(y);
      for (int x = 0; x < width; ++x)
      {
        to[x] = to[x] == both && status[x] != PixelStatus::None ? 1 : 0;
      }
    });
  return contour;
}

} // namespace gnomon
