// pcf_estimator.glsl against closed forms: the texels that each kernel reads, and their weights.

#include "EstimatorGlsl.h"

#include "shadowtech/depth_map/Pcf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test
{
namespace
{

/// Run the shader on a map of a sun above.
std::vector<float> runPcf(
  const ShadowLight& light, const Map& map, const std::vector<glm::dvec2>& places)
{
  return runGlsl(Pcf(), light, sunViews(light), map, places);
}

using PcfGlsl = GlslTest;

TEST_F(PcfGlsl, bilinearWeighsTexelsByHowFarASquareCoversThem)
{
  // Size 1 is the bilinear filter of four comparisons.
  for (const int texels : { 1, 2, 3, 4, 7 })
  {
    const std::vector<glm::dvec2> places = randomPlaces(texels);
    const std::vector<float> values = runPcf(filteredSun("bilinear", texels), scattered, places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double expected = litShare(
        scattered, [&](const glm::ivec2& texel) { return covered(texel, places[i], texels); });
      ASSERT_NEAR(values[i], expected, 1e-4) << texels << " texels, place " << i;
    }
  }
}

TEST_F(PcfGlsl, boxCountsTheNearestTexels)
{
  for (const int texels : { 1, 2, 3, 5, 8 })
  {
    const std::vector<glm::dvec2> places = randomPlaces(texels);
    const std::vector<float> values = runPcf(filteredSun("box", texels), scattered, places);
    std::size_t different = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double half = 0.5 * texels;
      const double expected = litShare(scattered,
        [&](const glm::ivec2& texel)
        {
          const glm::dvec2 away = glm::abs(glm::dvec2(texel) + 0.5 - places[i]);
          return away.x <= half && away.y <= half ? 1.0 : 0.0;
        });
      different += std::abs(values[i] - expected) < 1e-6 ? 0 : 1;
    }
    // At places within rounding of a texel's border, the twin may take the other texel.
    EXPECT_LE(different, 2u) << texels << " texels";
  }
}

/// Castano's published filters of 3 x 3 and 5 x 5 texels: bilinear lookups in each direction, by
/// the point's place between two texels.
struct Lookup
{
  double place; ///< texels from the first of the two texels
  double weight;
};
std::vector<Lookup> castanoLookups(int texels, double s)
{
  if (texels == 3)
  {
    return { { (2 - s) / (3 - 2 * s) - 1, 3 - 2 * s }, { s / (1 + 2 * s) + 1, 1 + 2 * s } };
  }
  if (texels == 5)
  {
    return { { (3 - 2 * s) / (4 - 3 * s) - 2, 4 - 3 * s }, { (3 + s) / 7, 7 },
      { s / (1 + 3 * s) + 2, 1 + 3 * s } };
  }
  return { { (5 * s - 6 == 0 ? 0 : (4 * s - 5) / (5 * s - 6)) - 3, 6 - 5 * s },
    { (4 * s - 16) / (11 * s - 28) - 1, 28 - 11 * s },
    { (7 * s + 5) / (11 * s + 17) + 1, 11 * s + 17 }, { s / (5 * s + 1) + 3, 5 * s + 1 } };
}

/// Return the result of a texture unit's bilinear filter of comparisons.
double litBilinear(const Map& map, const glm::dvec2& place)
{
  return litShare(map, [&](const glm::ivec2& texel) { return covered(texel, place, 1.0); });
}

TEST_F(PcfGlsl, castanoIsHisSumOfBilinearLookups)
{
  for (const int texels : { 3, 5, 7 })
  {
    std::vector<glm::dvec2> places = randomPlaces(texels);
    places.resize(300);
    places.emplace_back(20.5, 20.5); // at a texel's centre
    const std::vector<float> values = runPcf(filteredSun("castano", texels), scattered, places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const glm::dvec2 base = glm::floor(places[i] + 0.5);
      const glm::dvec2 s = places[i] + 0.5 - base;
      double lit = 0.0;
      double all = 0.0;
      for (const Lookup& y : castanoLookups(texels, s.y))
      {
        for (const Lookup& x : castanoLookups(texels, s.x))
        {
          lit +=
            x.weight * y.weight * litBilinear(scattered, base - 0.5 + glm::dvec2(x.place, y.place));
          all += x.weight * y.weight;
        }
      }
      ASSERT_NEAR(values[i], lit / all, 1e-4) << texels << " texels, place " << i;
    }
  }
}

TEST_F(PcfGlsl, theMapsEndIsReadAgainWhereAKernelIsWider)
{
  // The whole border is covered, unlike in any real view.
  const Map everywhere = [](const glm::ivec2&) { return true; };
  const Map nowhere = [](const glm::ivec2&) { return false; };
  const std::vector<glm::dvec2> places = { { 0.5, 0.5 }, { 63.9, 0.1 }, { 63.5, 63.5 } };
  for (const char* kernel : { "bilinear", "box", "poisson" })
  {
    const ShadowLight light = filteredSun(kernel, 32);
    EXPECT_EQ(runPcf(light, everywhere, places), std::vector<float>(3, 0.0f)) << kernel;
    EXPECT_EQ(runPcf(light, nowhere, places), std::vector<float>(3, 1.0f)) << kernel;
  }
}

} // namespace
} // namespace gnomon::test
