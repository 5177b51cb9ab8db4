#include "lights/ReducedMd5.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::test
{
namespace
{

constexpr int width = 1024;
constexpr int height = 768;

glm::uvec4 ofPixel(int column, int row)
{
  return reducedMd5({ column, row, 0, 0 }, 0u);
}

int bitsOf(const glm::uvec4& words)
{
  int bits = 0;
  for (int word = 0; word < 4; ++word)
  {
    for (std::uint32_t rest = words[word]; rest != 0u; rest &= rest - 1u)
    {
      ++bits;
    }
  }
  return bits;
}

/// From an implementation of its own.
TEST(ReducedMd5, givesThePublishedNumbers)
{
  struct Case
  {
    glm::uvec4 seed;
    std::uint32_t key;
    glm::uvec4 words;
  };
  const std::array<Case, 8> cases{ {
    { { 0u, 0u, 0u, 0u }, 0u, { 0x9849996eu, 0x61c2b03bu, 0x4663dbefu, 0xfe85c476u } },
    { { 1u, 0u, 0u, 0u }, 0u, { 0xfc6c0fb3u, 0xfd47b408u, 0x04f5305du, 0xef967456u } },
    { { 0u, 1u, 0u, 0u }, 0u, { 0x7681c30bu, 0xac1462e8u, 0x869fd967u, 0xa3e26fb4u } },
    { { 1u, 2u, 3u, 4u }, 0u, { 0x4f68a50bu, 0x55ec1f9eu, 0x00f7d906u, 0x00f77bd5u } },
    { { 0u, 0u, 0u, 0u }, 0xdeadbeefu, { 0x0747bb04u, 0x0a54e35du, 0x541e778du, 0xf4b80748u } },
    { { 100u, 200u, 0u, 0u }, 0u, { 0xe650601fu, 0xd424ea9cu, 0x4aad8c25u, 0x70350f73u } },
    { { 1023u, 767u, 0u, 0u }, 7u, { 0x6c64bb06u, 0x4939c55cu, 0x782a3a23u, 0x99d885ecu } },
    { glm::uvec4(0xffffffffu), 0u, { 0x8cb35b63u, 0xf614ce39u, 0xe9a694d6u, 0x31c50d7bu } },
  } };
  for (const Case& each : cases)
  {
    EXPECT_EQ(reducedMd5(each.seed, each.key), each.words) << each.seed.x << " " << each.key;
  }
}

TEST(ReducedMd5, flipsHalfOfTheBitsWhateverBitOfThePlaceIsFlipped)
{
  // Of the bits that count pixels: 64 places, 128 bits each.
  for (int word = 0; word < 2; ++word)
  {
    for (std::uint32_t bit = 0; bit < 10; ++bit)
    {
      int flipped = 0;
      for (int place = 0; place < 64; ++place)
      {
        glm::uvec4 seed(place * 13, place * 7, 0, 0);
        const glm::uvec4 before = reducedMd5(seed, 0u);
        seed[word] ^= 1u << bit;
        flipped += bitsOf(before ^ reducedMd5(seed, 0u));
      }
      EXPECT_NEAR(flipped / (64.0 * 128.0), 0.5, 0.025) << "word " << word << ", bit " << bit;
    }
  }
}

TEST(ReducedMd5, isEvenAndHasNothingToDoWithItsNeighbours)
{
  std::array<std::array<int, 256>, 4> bins{};
  std::array<double, 4> product{};
  constexpr double pixels = double(width) * height;
  const auto fraction = [](std::uint32_t word) { return word / 4294967296.0 - 0.5; };
  for (int row = 0; row < height; ++row)
  {
    glm::uvec4 left = ofPixel(-1, row);
    for (int column = 0; column < width; ++column)
    {
      const glm::uvec4 words = ofPixel(column, row);
      for (int word = 0; word < 4; ++word)
      {
        ++bins[static_cast<std::size_t>(word)][words[word] >> 24];
        product[static_cast<std::size_t>(word)] += fraction(words[word]) * fraction(left[word]);
      }
      left = words;
    }
  }
  for (std::size_t word = 0; word < 4; ++word)
  {
    double chiSquared = 0.0;
    for (const int count : bins[word])
    {
      chiSquared += (count - pixels / 256.0) * (count - pixels / 256.0) / (pixels / 256.0);
    }
    // 255 degrees of freedom: 5 standard deviations of 22.6 around them.
    EXPECT_NEAR(chiSquared, 255.0, 113.0) << "word " << word;
    EXPECT_LT(std::abs(product[word] / pixels * 12.0), 0.005) << "correlation, word " << word;
  }
}

} // namespace
} // namespace gnomon::test
