#include "lights/ReducedMd5.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int width = 1024;
constexpr int height = 768;

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

/// Computed by a separate implementation.
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

/// The hash depends only on the place, so its statistics over a picture are fixed numbers. The
/// bounds are those that the separate implementation above gave for seeds (x, y, 0, 0), rounded as
/// there.
TEST(ReducedMd5, flipsHalfOfTheBitsWhateverBitOfThePlaceIsFlipped)
{
  constexpr int rows = height / 8; // every eighth
  double sum = 0.0;
  for (int word = 0; word < 2; ++word)
  {
    for (std::uint32_t bit = 0; bit < 32; ++bit)
    {
      std::int64_t flipped = 0;
      for (int row = 0; row < rows; ++row)
      {
        for (int column = 0; column < width; ++column)
        {
          glm::uvec4 seed(column, 8 * row, 0, 0);
          const glm::uvec4 before = reducedMd5(seed, 0u);
          seed[word] ^= 1u << bit;
          flipped += bitsOf(before ^ reducedMd5(seed, 0u));
        }
      }
      const double share = static_cast<double>(flipped) / (128.0 * rows * width);
      EXPECT_GT(share, 0.4965) << "word " << word << ", bit " << bit;
      EXPECT_LT(share, 0.5025) << "word " << word << ", bit " << bit;
      sum += share;
    }
  }
  EXPECT_NEAR(sum / 64.0, 0.5, 0.0005);
}

/// Return the hashes of a picture, row by row.
std::vector<glm::uvec4> ofPicture()
{
  std::vector<glm::uvec4> hashes;
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      hashes.push_back(reducedMd5({ column, row, 0, 0 }, 0u));
    }
  }
  return hashes;
}

/// Return the unevenness of 256 bins, with 255 degrees of freedom.
double chiSquared(const std::array<int, 256>& bins)
{
  constexpr double expected = double(width) * height / 256.0;
  double sum = 0.0;
  for (const int count : bins)
  {
    sum += (count - expected) * (count - expected) / expected;
  }
  return sum;
}

TEST(ReducedMd5, isEvenInEachWordAndInPairsOfThem)
{
  const std::vector<glm::uvec4> hashes = ofPicture();
  for (int word = 0; word < 4; ++word)
  {
    std::array<int, 256> bytes{};
    for (const glm::uvec4& hash : hashes)
    {
      ++bytes[hash[word] >> 24];
    }
    EXPECT_GT(chiSquared(bytes), 263.5) << "word " << word;
    EXPECT_LT(chiSquared(bytes), 292.5) << "word " << word;
    for (int other = word + 1; other < 4; ++other)
    {
      std::array<int, 256> pairs{};
      for (const glm::uvec4& hash : hashes)
      {
        ++pairs[16u * (hash[word] >> 28) + (hash[other] >> 28)];
      }
      EXPECT_GT(chiSquared(pairs), 241.5) << "words " << word << ", " << other;
      EXPECT_LT(chiSquared(pairs), 279.5) << "words " << word << ", " << other;
    }
  }
}

TEST(ReducedMd5, hasNothingToDoWithItsNeighbours)
{
  const std::vector<glm::uvec4> hashes = ofPicture();
  const auto fraction = [](std::uint32_t word) { return word / 4294967296.0 - 0.5; };
  for (const bool above : { false, true })
  {
    const std::size_t step = above ? width : 1;
    for (int word = 0; word < 4; ++word)
    {
      double product = 0.0;
      double count = 0.0;
      for (std::size_t i = step; i < hashes.size(); ++i)
      {
        if (!above && i % width == 0)
        {
          continue;
        }
        product += fraction(hashes[i][word]) * fraction(hashes[i - step][word]);
        count += 1.0;
      }
      // The variance of a uniform fraction is 1/12.
      EXPECT_LT(std::abs(12.0 * product / count), 0.001)
        << "word " << word << (above ? " of rows" : " of columns");
    }
  }
}

} // namespace
} // namespace gnomon::test
