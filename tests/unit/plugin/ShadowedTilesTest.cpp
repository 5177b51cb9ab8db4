// The tiles of a picture that hold shadows.

#include "plugin/frame/ShadowedTiles.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

using namespace gnomon;

namespace
{

using Rectangles = std::vector<ShadowedTiles::Rectangle>;

/// A picture's visibility: lit, except for rectangles.
std::vector<float> litBut(const glm::ivec2& size, const Rectangles& shadows)
{
  std::vector<float> visibility(static_cast<std::size_t>(size.x * size.y), 1.0f);
  for (const auto& [lower, upper] : shadows)
  {
    for (int y = lower.y; y < upper.y; ++y)
    {
      for (int x = lower.x; x < upper.x; ++x)
      {
        visibility[static_cast<std::size_t>(y * size.x + x)] = 0.0f;
      }
    }
  }
  return visibility;
}

bool holds(const Rectangles& rectangles, int x, int y)
{
  for (const auto& [lower, upper] : rectangles)
  {
    if (lower.x <= x && x < upper.x && lower.y <= y && y < upper.y)
    {
      return true;
    }
  }
  return false;
}

} // namespace

TEST(ShadowedTiles, AreNoneWhereAllIsLit)
{
  const ShadowedTiles tiles = findShadowedTiles(litBut({ 50, 40 }, {}), { 50, 40 });
  EXPECT_TRUE(tiles.inPart.empty());
  EXPECT_TRUE(tiles.whole.empty());
}

TEST(ShadowedTiles, JoinNeighboursOfOneKind)
{
  // The last tiles of a row and of a column have 2 and 8 pixels.
  const glm::ivec2 size(50, 40);
  const ShadowedTiles tiles =
    findShadowedTiles(litBut(size, { { { 16, 0 }, { 50, 16 } }, { { 0, 32 }, { 33, 40 } } }), size);
  EXPECT_EQ(tiles.whole, (Rectangles{ { { 16, 0 }, { 50, 16 } }, { { 0, 32 }, { 32, 40 } } }));
  EXPECT_EQ(tiles.inPart, (Rectangles{ { { 32, 32 }, { 48, 40 } } }));
}

TEST(ShadowedTiles, HoldEveryPixelInShadow)
{
  std::mt19937 random(7);
  const glm::ivec2 size(83, 61);
  for (int round = 0; round < 20; ++round)
  {
    std::vector<float> visibility = litBut(size, { { { 0, 16 }, { 40, 48 } } });
    for (int i = 0; i < 5; ++i)
    {
      visibility[random() % visibility.size()] = 0.0f;
    }
    const ShadowedTiles tiles = findShadowedTiles(visibility, size);
    for (int y = 0; y < size.y; ++y)
    {
      for (int x = 0; x < size.x; ++x)
      {
        const bool isDark = visibility[static_cast<std::size_t>(y * size.x + x)] == 0.0f;
        EXPECT_TRUE(!isDark || holds(tiles.inPart, x, y) || holds(tiles.whole, x, y));
        EXPECT_TRUE(isDark || !holds(tiles.whole, x, y));
        EXPECT_FALSE(holds(tiles.inPart, x, y) && holds(tiles.whole, x, y));
      }
    }
  }
}

TEST(ShadowedTiles, TellOfPixelsBetweenLightAndShadow)
{
  const glm::ivec2 size(32, 16);
  std::vector<float> visibility = litBut(size, { { { 0, 0 }, { 16, 16 } } });
  EXPECT_FALSE(findShadowedTiles(visibility, size).mixes);
  visibility[20] = 0.5f;
  const ShadowedTiles lit = findShadowedTiles(visibility, size);
  EXPECT_TRUE(lit.mixes);
  EXPECT_EQ(lit.inPart, (Rectangles{ { { 16, 0 }, { 32, 16 } } }));
  EXPECT_EQ(lit.whole, (Rectangles{ { { 0, 0 }, { 16, 16 } } }));
  visibility[5] = 0.5f;
  EXPECT_EQ(findShadowedTiles(visibility, size).inPart, (Rectangles{ { { 0, 0 }, { 32, 16 } } }));
}
