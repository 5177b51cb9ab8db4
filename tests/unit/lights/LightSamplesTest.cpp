#include "lights/LightSamples.h"

#include "lights/HashedPoints.h"
#include "lights/ReducedMd5.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

const glm::dvec3 samplesCentre(10.0, 20.0, 30.0);
const glm::dvec3 travel = glm::normalize(glm::dvec3(1.0, -2.0, -0.5));
constexpr double size = 0.5;

ShadowLight lightOf(LightKind kind)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = { 11.0, 22.0, 33.0 };
  light.directionWorld = travel;
  light.coneAngleDegrees = 30.0;
  light.area = kind == LightKind::Point ? ballArea(size) : diskArea(travel, size);
  light.lightSamples = 256;
  return light;
}

/// A square across z with half side 1; its offsets equal its own coordinates.
LightSamples squareSamples(int count, int seed = 0, LightSampling sampling = LightSampling::Sobol)
{
  ShadowLight light = lightOf(LightKind::Spot);
  light.area =
    rectangleArea(glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec2(1.0));
  light.lightSamples = count;
  light.lightSeed = seed;
  light.lightSampling = sampling;
  return LightSamples(light);
}

/// Return the place of a point of that square, in [0, 1).
glm::vec2 placeOf(const glm::vec3& offset)
{
  return 0.5f * (glm::vec2(offset) + 1.0f);
}

/// Cut the square into as many parts of equal area as there are points, with sides that are powers
/// of two, in every way. Expect one point in each part.
/// @param mostColumnBits the narrowest parts' width, as a power of 1/2
void expectOneInEachPart(const std::vector<glm::vec2>& places, int mostColumnBits)
{
  for (int columnBits = 0; columnBits <= mostColumnBits; ++columnBits)
  {
    const auto columns = static_cast<float>(1 << columnBits);
    const float rows = static_cast<float>(places.size()) / columns;
    std::set<std::pair<int, int>> parts;
    for (const glm::vec2& place : places)
    {
      EXPECT_TRUE(place.x >= 0.0f && place.x < 1.0f);
      parts.insert({ static_cast<int>(place.x * columns), static_cast<int>(place.y * rows) });
    }
    EXPECT_EQ(parts.size(), places.size()) << columns << " columns";
  }
}

TEST(LightSamples, ofAHardLightAreItsPlace)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot, LightKind::Point })
  {
    ShadowLight light = lightOf(kind);
    light.area.reset();
    const std::vector<glm::dvec4> samples = lightSamples(light, samplesCentre);
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0], lightPoint(light, samplesCentre));
  }
  EXPECT_EQ(lightPoint(lightOf(LightKind::Point), samplesCentre), glm::dvec4(1.0, 2.0, 3.0, 1.0));
  const glm::dvec4 sun = lightPoint(lightOf(LightKind::Directional), samplesCentre);
  EXPECT_NEAR(glm::distance(glm::dvec3(sun), -travel), 0.0, 1e-15);
  EXPECT_EQ(sun.w, 0.0);
}

TEST(LightSamples, ofALightWithoutSizeAreItsCentre)
{
  const std::vector<glm::dvec3> alone{ glm::dvec3(0.0) };
  ShadowLight light = lightOf(LightKind::Spot);
  for (const LightArea& area : { diskArea(travel, 0.0), ballArea(0.0),
         rectangleArea(travel, glm::dvec3(0.0, 1.0, 0.0), glm::dvec2(0.0)) })
  {
    light.area = area;
    const LightSamples samples(light);
    for (int i = 0; i < samples.count(); ++i)
    {
      EXPECT_EQ(samples.offset(i, samples.pixel(3, 4)), glm::vec3(0.0f));
    }
    EXPECT_EQ(pairedLightSamples(light), alone);
  }
  light.area.reset();
  EXPECT_EQ(pairedLightSamples(light), alone);
}

TEST(LightSamples, fillADiscAcrossTheLight)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot })
  {
    const ShadowLight light = lightOf(kind);
    const glm::dvec3 middle(lightPoint(light, samplesCentre));
    glm::dvec3 mean(0.0);
    int inner = 0;
    for (const glm::dvec4& sample : lightSamples(light, samplesCentre))
    {
      glm::dvec3 offset = glm::dvec3(sample) - middle;
      if (kind == LightKind::Directional)
      {
        // The radius is the tangent of the light's angle.
        EXPECT_NEAR(glm::length(glm::dvec3(sample)), 1.0, 1e-12);
        offset = glm::dvec3(sample) / glm::dot(glm::dvec3(sample), middle) - middle;
      }
      EXPECT_NEAR(glm::dot(offset, travel), 0.0, 1e-6);
      EXPECT_LE(glm::length(offset), size * (1.0 + 1e-6));
      inner += glm::length(offset) < size * std::sqrt(0.5) ? 1 : 0;
      mean += offset / 256.0;
    }
    EXPECT_NEAR(inner, 128, 8) << "half of the area";
    EXPECT_LT(glm::length(mean), 0.01);
  }
}

TEST(LightSamples, ofALampLookLikeAnEvenDiscFromAllSides)
{
  ShadowLight light = lightOf(LightKind::Point);
  light.lightSamples = 1024;
  for (const glm::dvec3& axis :
    { glm::dvec3(1.0, 0.0, 0.0), { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 0.48, -0.6, 0.64 } })
  {
    for (const double share : { 0.1, 0.25, 0.5, 0.75, 0.9 })
    {
      int inside = 0;
      for (const glm::dvec4& sample : lightSamples(light, samplesCentre))
      {
        const glm::dvec3 offset = glm::dvec3(sample) - glm::dvec3(1.0, 2.0, 3.0);
        inside +=
          glm::length(offset - glm::dot(offset, axis) * axis) < size * std::sqrt(share) ? 1 : 0;
        EXPECT_LE(glm::length(offset), size * (1.0 + 1e-6));
      }
      EXPECT_NEAR(inside / 1024.0, share, 0.02);
    }
  }
}

TEST(LightSamples, ofEveryPixelHoldOnePointInEachPartOfEqualArea)
{
  for (const int bits : { 0, 1, 2, 5, 8, 12 })
  {
    for (const int seed : { 0, 7 })
    {
      const LightSamples samples = squareSamples(1 << bits, seed);
      for (const SamplePixel& pixel :
        { SamplePixel{}, samples.pixel(0, 0), samples.pixel(641, 480) })
      {
        std::vector<glm::vec2> places;
        for (int i = 0; i < samples.count(); ++i)
        {
          places.push_back(placeOf(samples.offset(i, pixel)));
        }
        expectOneInEachPart(places, bits);
      }
    }
  }
}

TEST(LightSamples, ofOneNumberLieInTheSamePartForAllPixels)
{
  const LightSamples samples = squareSamples(64);
  for (int i = 0; i < 64; ++i)
  {
    const glm::vec2 here = placeOf(samples.offset(i, samples.pixel(1, 2)));
    const glm::vec2 there = placeOf(samples.offset(i, samples.pixel(100, 7)));
    EXPECT_EQ(glm::floor(here * 8.0f), glm::floor(there * 8.0f));
    EXPECT_NE(here, there);
  }
}

/// Return the RMS error of the share of a square that lies on one side of a slanted line. The line
/// moves from pixel to pixel.
/// @param side errors are averaged over side x side pixels
double halfPlaneError(const LightSamples& samples, int side)
{
  constexpr int width = 64;
  const glm::dvec2 across(0.8, 0.6);
  std::vector<double> errors;
  for (int pixel = 0; pixel < width * width; ++pixel)
  {
    const int column = pixel % width, row = pixel / width;
    const double limit = (column + 0.37 * row) / width - 0.7;
    // The area of a quadrant without the areas beyond the square's sides.
    const auto quadrant = [&](double x, double y)
    { return std::pow(std::max(limit + across.x * x + across.y * y, 0.0), 2.0); };
    const double truth = (quadrant(1, 1) - quadrant(-1, 1) - quadrant(1, -1) + quadrant(-1, -1)) /
      (2.0 * across.x * across.y * 4.0);
    int inside = 0;
    const SamplePixel of =
      samples.pixel(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    for (int i = 0; i < samples.count(); ++i)
    {
      inside += glm::dot(glm::dvec2(samples.offset(i, of)), across) < limit ? 1 : 0;
    }
    errors.push_back(static_cast<double>(inside) / samples.count() - truth);
  }
  double sum = 0.0;
  int blocks = 0;
  for (int row = 0; row + side <= width; ++row)
  {
    for (int column = 0; column + side <= width; ++column, ++blocks)
    {
      double mean = 0.0;
      for (int i = 0; i < side * side; ++i)
      {
        mean += errors[static_cast<std::size_t>((row + i / side) * width + column + i % side)] /
          (side * side);
      }
      sum += mean * mean;
    }
  }
  return std::sqrt(sum / blocks);
}

TEST(LightSamples, errLeastByDefaultAndLeaveTheLeastNoiseToABlur)
{
  for (const int count : { 4, 16, 64 })
  {
    double sobol = 0.0, sobolBlurred = 0.0;
    for (const int seed : { 0, 1, 2, 3 })
    {
      sobol += halfPlaneError(squareSamples(count, seed), 1) / 4.0;
      sobolBlurred += halfPlaneError(squareSamples(count, seed), 3) / 4.0;
    }
    const LightSamples jittered = squareSamples(count, 0, LightSampling::Jittered);
    const LightSamples random = squareSamples(count, 0, LightSampling::Random);
    EXPECT_LT(sobol, halfPlaneError(jittered, 1)) << count;
    EXPECT_LT(halfPlaneError(jittered, 1), halfPlaneError(random, 1)) << count;
    // Noise that is independent of its neighbours drops by a factor of 3 over 3 x 3.
    EXPECT_NEAR(halfPlaneError(jittered, 3) / halfPlaneError(jittered, 1), 1.0 / 3.0, 0.03);
    EXPECT_LT(sobolBlurred, 0.3 * sobol) << count;
  }
}

/// Return the deviation of pair counts in 16 x 16 cells from chance, in standard deviations.
double dependenceOf(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs)
{
  constexpr double degreesOfFreedom = 255.0;
  std::array<double, 256> counts{};
  for (const auto& [a, b] : pairs)
  {
    counts[a >> 28 << 4 | b >> 28] += 1.0;
  }
  const double expected = static_cast<double>(pairs.size()) / 256.0;
  double chiSquared = 0.0;
  for (const double count : counts)
  {
    chiSquared += (count - expected) * (count - expected) / expected;
  }
  return (chiSquared - degreesOfFreedom) / std::sqrt(2.0 * degreesOfFreedom);
}

TEST(LightSamples, atRandomHaveCoordinatesThatDoNotDependOnEachOther)
{
  for (std::uint32_t key = 0; key < 32; ++key)
  {
    const HashedPoints points(3, 1, key);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> xy, xz, yz;
    for (std::uint32_t pixel = 0; pixel < 64u * 64u; ++pixel)
    {
      for (int i = 0; i < 64; ++i)
      {
        const glm::uvec3 point = points.point(i, points.pixel(pixel % 64u, pixel / 64u));
        xy.emplace_back(point.x, point.y);
        xz.emplace_back(point.x, point.z);
        yz.emplace_back(point.y, point.z);
      }
    }
    EXPECT_LT(dependenceOf(xy), 5.0) << key;
    EXPECT_LT(dependenceOf(xz), 5.0) << key;
    EXPECT_LT(dependenceOf(yz), 5.0) << key;
  }
}

TEST(LightSamples, ofPixelsAndSeedsDiffer)
{
  for (const LightSampling sampling :
    { LightSampling::Sobol, LightSampling::Jittered, LightSampling::Random })
  {
    for (const int count : { 1, 16, 100 })
    {
      const LightSamples samples = squareSamples(count, 0, sampling);
      const LightSamples others = squareSamples(count, 1, sampling);
      std::set<std::pair<float, float>> places;
      for (std::uint32_t row = 0; row < 16; ++row)
      {
        for (std::uint32_t column = 0; column < 16; ++column)
        {
          const glm::vec2 here = placeOf(samples.offset(count - 1, samples.pixel(column, row)));
          const glm::vec2 other = placeOf(others.offset(count - 1, others.pixel(column, row)));
          places.insert({ here.x, here.y });
          places.insert({ other.x, other.y });
        }
      }
      EXPECT_EQ(places.size(), 512u) << count;
    }
  }
}

TEST(LightSamples, inPairsAreOppositeAndGoFromTheMiddleOutwards)
{
  for (const LightKind kind : { LightKind::Directional, LightKind::Spot, LightKind::Point })
  {
    for (const int count : { 1, 2, 3, 16, 100, 257 })
    {
      ShadowLight light = lightOf(kind);
      light.lightSamples = count;
      const std::vector<glm::dvec3> samples = pairedLightSamples(light);
      ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
      const std::size_t odd = count % 2;
      if (odd)
      {
        EXPECT_EQ(samples[0], glm::dvec3(0.0));
      }
      for (std::size_t i = odd; i < samples.size(); i += 2)
      {
        EXPECT_EQ(samples[i], -samples[i + 1]);
        EXPECT_LE(glm::length(samples[i]), size * (1.0 + 1e-6));
        if (i > odd)
        {
          EXPECT_LE(glm::length(samples[i - 1]), glm::length(samples[i]));
        }
      }
      light.lightSeed = 1;
      EXPECT_EQ(pairedLightSamples(light) == samples, count == 1);
    }
  }
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

// Arithmetic that must not depend on the processor for which the code is compiled.

/// Compiled for processors that can fuse multiplication and addition.
#ifdef __x86_64__
[[gnu::target("fma")]]
#endif
double
productAndSum(const volatile double& a, const volatile double& b, const volatile double& c)
{
  return a * b + c;
}

TEST(FloatingPoint, productsAreRoundedBeforeTheyAreAdded)
{
#ifdef __x86_64__
  if (!__builtin_cpu_supports("fma"))
  {
    GTEST_SKIP() << "this processor fuses nothing";
  }
#endif
  // The square is 1 + 2^-29 + 2^-60; a double holds all but the last bit.
  const double factor = 1.0 + 0x1p-30;
  const double less = -(1.0 + 0x1p-29);
  EXPECT_EQ(productAndSum(factor, factor, less), 0.0);
}

} // namespace
} // namespace gnomon::test
