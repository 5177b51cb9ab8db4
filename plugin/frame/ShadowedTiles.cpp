#include "plugin/frame/ShadowedTiles.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{
namespace
{

constexpr int tileSide = 16; // pixels

/// How many pixels of a tile are not fully lit.
struct Darkness
{
  int dark = 0; ///< in shadow
  int dim = 0;  ///< in shadow, or between light and shadow
};

/// Count the pixels of each tile in a row of tiles.
void countDark(const std::vector<float>& visibility, int width, int bottom, int top,
  std::vector<Darkness>& tiles)
{
  std::fill(tiles.begin(), tiles.end(), Darkness{});
  for (int y = bottom; y < top; ++y)
  {
    const float* row =
      visibility.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int left = 0; left < width; left += tileSide)
    {
      Darkness& tile = tiles[static_cast<std::size_t>(left / tileSide)];
      const int right = std::min(left + tileSide, width);
      for (int x = left; x < right; ++x)
      {
        tile.dark += row[x] == 0.0f ? 1 : 0;
        tile.dim += row[x] < 1.0f ? 1 : 0;
      }
    }
  }
}

} // namespace

ShadowedTiles findShadowedTiles(const std::vector<float>& visibility, const glm::ivec2& size)
{
  ShadowedTiles tiles;
  std::vector<Darkness> ofRow(static_cast<std::size_t>((size.x + tileSide - 1) / tileSide));
  for (int bottom = 0; bottom < size.y; bottom += tileSide)
  {
    const int top = std::min(bottom + tileSide, size.y);
    countDark(visibility, size.x, bottom, top, ofRow);
    std::vector<ShadowedTiles::Rectangle>* before = nullptr; // of the tile to the left
    for (int left = 0; left < size.x; left += tileSide)
    {
      const int right = std::min(left + tileSide, size.x);
      const Darkness& tile = ofRow[static_cast<std::size_t>(left / tileSide)];
      std::vector<ShadowedTiles::Rectangle>* const kind = tile.dim == 0 ? nullptr
        : tile.dark < (right - left) * (top - bottom)                   ? &tiles.inPart
                                                                        : &tiles.whole;
      tiles.mixes |= tile.dim > tile.dark;
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
