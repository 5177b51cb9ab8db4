#include "shadowtech/base/ShadowedTiles.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{
namespace
{

constexpr int tileSide = 16; // pixels

/// How many pixels of each of a row's tiles are in shadow.
void countDark(
  const std::vector<float>& visibility, int width, int bottom, int top, std::vector<int>& dark)
{
  std::fill(dark.begin(), dark.end(), 0);
  for (int y = bottom; y < top; ++y)
  {
    const float* row =
      visibility.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width; x += tileSide)
    {
      dark[static_cast<std::size_t>(x / tileSide)] += static_cast<int>(std::count_if(
        row + x, row + std::min(x + tileSide, width), [](float of) { return of == 0.0f; }));
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
ShadowedTiles findShadowedTiles(const std::vector<float>& visibility, const glm::ivec2& size)
{
  ShadowedTiles tiles;
  std::vector<int> dark(static_cast<std::size_t>((size.x + tileSide - 1) / tileSide));
  for (int bottom = 0; bottom < size.y; bottom += tileSide)
  {
    const int top = std::min(bottom + tileSide, size.y);
    countDark(visibility, size.x, bottom, top, dark);
    std::vector<ShadowedTiles::Rectangle>* before = nullptr; // of the tile to the left
    for (int left = 0; left < size.x; left += tileSide)
    {
      const int right = std::min(left + tileSide, size.x);
      const int pixels = dark[static_cast<std::size_t>(left / tileSide)];
      std::vector<ShadowedTiles::Rectangle>* const kind = pixels == 0 ? nullptr
        : pixels < (right - left) * (top - bottom)                    ? &tiles.inPart
                                                                      : &tiles.whole;
      if (kind && kind == before)
      {
        kind->back().upper.x = right;
      }
      else if (kind)
      {
        kind->push_back({ { left, bottom }, { right, top } });
      }
      before = kind;
    }
  }
  return tiles;
}

} // namespace gnomon
