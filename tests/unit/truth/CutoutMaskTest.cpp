// Where a texture has alpha: known answers, and a twin that sums weights.

#include "shadowtech/base/CutoutMask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gnomon::test
{
namespace
{

CutoutMask makeMask(TextureWrap wrap, bool interpolated)
{
  CutoutMask mask;
  mask.width = 4;
  mask.height = 3;
  mask.texels = { 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0 };
  mask.wrap = wrap;
  mask.interpolated = interpolated;
  return mask;
}

/// Return the texel of a wrapped index (OpenGL 4.5, table 8.20); negative for the border.
int wrapped(int i, int size, TextureWrap wrap)
{
  const auto modulo = [](int a, int b) { return ((a % b) + b) % b; };
  switch (wrap)
  {
    case TextureWrap::ClampToEdge:
      return i < 0 ? 0 : i >= size ? size - 1 : i;
    case TextureWrap::ClampToBorder:
      return i < 0 || i >= size ? -1 : i;
    case TextureWrap::MirroredRepeat:
    {
      const int a = modulo(i, 2 * size) - size;
      return size - 1 - (a >= 0 ? a : -(1 + a));
    }
    case TextureWrap::Repeat:
      break;
  }
  return modulo(i, size);
}

/// Return the filtered alpha (OpenGL 4.5, 8.14.2).
double alphaAt(const CutoutMask& mask, const glm::dvec2& coordinates)
{
  const auto texel = [&](int x, int y)
  {
    const int i = wrapped(x, mask.width, mask.wrap);
    const int j = wrapped(y, mask.height, mask.wrap);
    return i < 0 || j < 0 ? (mask.borderDrawn ? 1.0 : 0.0)
                          : mask.texels.at(static_cast<std::size_t>(j * mask.width + i)) / 255.0;
  };
  const glm::dvec2 place = coordinates * glm::dvec2(mask.width, mask.height);
  if (!mask.interpolated)
  {
    return texel(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
  }
  const glm::dvec2 first = glm::floor(place - 0.5);
  const glm::dvec2 weight = place - 0.5 - first;
  const int x = static_cast<int>(first.x);
  const int y = static_cast<int>(first.y);
  return (1.0 - weight.x) * (1.0 - weight.y) * texel(x, y) +
    weight.x * (1.0 - weight.y) * texel(x + 1, y) + (1.0 - weight.x) * weight.y * texel(x, y + 1) +
    weight.x * weight.y * texel(x + 1, y + 1);
}

constexpr TextureWrap allWraps[] = { TextureWrap::ClampToEdge, TextureWrap::Repeat,
  TextureWrap::MirroredRepeat, TextureWrap::ClampToBorder };

TEST(CutoutMask, AgreesWithTheFilteredAlpha)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-2.0f, 3.0f);
  for (const TextureWrap wrap : allWraps)
  {
    for (const bool interpolated : { false, true })
    {
      for (const bool borderDrawn : { false, true })
      {
        CutoutMask mask = makeMask(wrap, interpolated);
        mask.borderDrawn = borderDrawn;
        int drawn = 0;
        for (int i = 0; i < 20000; ++i)
        {
          const glm::vec2 coordinates(anywhere(random), anywhere(random));
          const bool expected = alphaAt(mask, coordinates) > 0.0;
          drawn += expected ? 1 : 0;
          EXPECT_EQ(mask.isDrawn(coordinates), expected) << coordinates.x << " " << coordinates.y;
        }
        EXPECT_GT(drawn, 100);
        EXPECT_LT(drawn, 19900);
      }
    }
  }
}

TEST(CutoutMask, AnyCoordinatesHaveAnAnswer)
{
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr float large = std::numeric_limits<float>::max();
  constexpr float tiny = std::numeric_limits<float>::denorm_min();
  for (const TextureWrap wrap : allWraps)
  {
    for (const bool interpolated : { false, true })
    {
      const CutoutMask mask = makeMask(wrap, interpolated);
      for (const float x : { infinite, -infinite, large, -large, tiny, -tiny, 0.0f, 1.0f, -1.0f,
             std::nextafter(1.0f, 0.0f), std::numeric_limits<float>::quiet_NaN() })
      {
        for (const float y : { 0.5f, x })
        {
          mask.isDrawn({ x, y });
          mask.isDrawn({ y, x });
        }
      }
    }
  }
  // A border extends without end.
  CutoutMask mask = makeMask(TextureWrap::ClampToBorder, true);
  EXPECT_FALSE(mask.isDrawn({ large, 0.0f }));
  EXPECT_FALSE(mask.isDrawn({ 0.5f, -infinite }));
  mask.borderDrawn = true;
  EXPECT_TRUE(mask.isDrawn({ large, 0.0f }));
  EXPECT_TRUE(mask.isDrawn({ 0.5f, -infinite }));
}

} // namespace
} // namespace gnomon::test
