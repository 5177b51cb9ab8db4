// pcf_estimator.glsl against closed forms: the texels that each kernel reads, and their weights.

#include "EstimatorGlsl.h"
#include "HalfPlane.h"
#include "SyntheticScene.h"

#include "lights/Bounds.h"
#include "lights/KernelShape.h"
#include "lights/LightViews.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/KernelPoints.h"
#include "shadowtech/depth_map/Pcf.h"
#include "shadowtech/depth_map/PcssPoints.h"
#include "shadowtech/moment_map/MomentEstimators.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

// Kernels on warped maps have an even shape across the light.

/// Return the views of the sun, warped. The eye is in front of the map's lower side: texels at the
/// upper side are (1 + 2 / eye)^2 as high, and 1 + 2 / eye as wide, as at the lower one.
LightViews warpedViews(const ShadowLight& light, double eye)
{
  LightViews views = sunViews(light);
  glm::dmat3& map = views.views.front().mapFromAcross;
  // y' = a + b / (y + 1 + eye), w = y + 1 + eye.
  const double n = eye;
  const double f = eye + 2.0;
  const glm::dmat3 warp(n, 0.0, 0.0, 0.0, (f + n) / (f - n), 1.0, 0.0,
    (f + n) / (f - n) * (1.0 + eye) - 2.0 * f * n / (f - n), 1.0 + eye);
  map = warp * map;
  return views;
}

ShadowLight warpedSun(const char* kernel, int texels)
{
  ShadowLight light = filteredSun(kernel, texels);
  light.projection = Projection::Lispsm;
  return light;
}

glm::dvec2 singularValues(const glm::dmat2& matrix)
{
  const double sum = glm::length(matrix[0]) * glm::length(matrix[0]) +
    glm::length(matrix[1]) * glm::length(matrix[1]);
  const double det = glm::determinant(matrix);
  const double root = std::sqrt(std::max(sum * sum / 4.0 - det * det, 0.0));
  return { std::sqrt(sum / 2.0 + root), std::sqrt(std::max(sum / 2.0 - root, 0.0)) };
}

/// The Jacobian with its area as unit: its longer axis is at most `limit` long.
glm::dmat2 evenShape(const glm::dmat2& jacobian, double limit)
{
  const glm::dmat2 wished = jacobian / std::sqrt(glm::determinant(jacobian));
  const double stretch = singularValues(wished).x;
  if (stretch <= limit)
  {
    return wished;
  }
  const glm::dmat2 squared = wished * glm::transpose(wished); // stretch^2 along the longer axis
  const glm::dmat2 along = (squared - glm::dmat2(1.0 / (stretch * stretch))) /
    (stretch * stretch - std::pow(stretch, -2.0));
  const double shorter = limit / stretch;
  return (shorter * along + (glm::dmat2(1.0) - along) / shorter) * wished;
}

TEST(KernelShape, jacobianIsTheDerivative)
{
  const ShadowLight light = warpedSun("bilinear", 3);
  const glm::dmat3 texels = texelFromAcross(warpedViews(light, 0.3).views.front(), mapSize);
  for (const glm::dvec2& at : { glm::dvec2(0.0), { 0.7, -0.8 }, { -0.5, 0.9 } })
  {
    const glm::dmat2 jacobian = texelJacobian(texels, at);
    constexpr double step = 1e-6;
    for (int i = 0; i < 2; ++i)
    {
      glm::dvec2 offset(0.0);
      offset[i] = step;
      const glm::dvec2 derivative =
        (mapped(texels, at + offset) - mapped(texels, at - offset)) / (2.0 * step);
      EXPECT_NEAR(glm::distance(derivative, jacobian[i]), 0.0, 1e-4);
    }
  }
}

using KernelShapeGlsl = GlslTest;

TEST_F(KernelShapeGlsl, weighsTexelsInTheKernelsShape)
{
  for (const double eye : { 0.2, 1.0 })
  {
    for (const int texels : { 1, 3, 6 })
    {
      const ShadowLight light = warpedSun("bilinear", texels);
      const LightViews views = warpedViews(light, eye);
      const glm::dmat3 texelsFromAcross = texelFromAcross(views.views.front(), mapSize);
      const std::vector<glm::dvec2> places =
        randomPlaces(40); // the stretched kernel is on the map, too
      const std::vector<float> values = runGlsl(Pcf(), light, views, scattered, places);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        const glm::dvec2 across = mapped(glm::inverse(texelsFromAcross), places[i]);
        const glm::dmat2 kernelFromTexel =
          glm::inverse(evenShape(texelJacobian(texelsFromAcross, across), largestStretch(texels)));
        const double expected = litShare(scattered,
          [&](const glm::ivec2& texel)
          {
            const glm::dvec2 away = kernelFromTexel * (glm::dvec2(texel) + 0.5 - places[i]);
            const auto share = [&](double distance)
            { return glm::clamp(0.5 * (texels + 1) - std::abs(distance), 0.0, 1.0); };
            return share(away.x) * share(away.y);
          });
        ASSERT_NEAR(values[i], expected, 1e-3) << texels << " texels, place " << i;
      }
    }
  }
}

/// Turning keeps radii: a lit disk, in the kernel's shape, around a place holds as many points as
/// the table has within its radius, but for those that share a texel with its rim.
TEST_F(KernelShapeGlsl, poissonReadsATurnedDiscInTheKernelsShape)
{
  constexpr int texels = 28;
  const glm::dvec2 middle(32.1, 31.8);
  for (const bool warped : { false, true })
  {
    const ShadowLight light =
      warped ? warpedSun("poisson", texels) : filteredSun("poisson", texels);
    const LightViews views = warped ? warpedViews(light, 0.4) : sunViews(light);
    const glm::dmat3 map = texelFromAcross(views.views.front(), mapSize);
    const glm::dmat2 shape =
      evenShape(texelJacobian(map, mapped(glm::inverse(map), middle)), largestStretch(texels));
    EXPECT_TRUE(!warped || singularValues(shape).x > 1.5) << "the test says nothing";
    // Places in cells of their own around the middle.
    std::vector<glm::dvec2> places;
    for (int i = 0; i < 64; ++i)
    {
      places.push_back(middle + glm::dvec2(i % 8 - 4, i / 8 - 4) / 40.0);
    }
    for (const double radius : { 0.125 * texels, 0.25 * texels, 0.375 * texels, 0.47 * texels })
    {
      const Map outside = [&](const glm::ivec2& texel)
      { return glm::length(glm::inverse(shape) * (glm::dvec2(texel) + 0.5 - middle)) > radius; };
      const auto within = [&](double most)
      {
        return std::count_if(poissonDisc().begin(), poissonDisc().end(),
          [&](const glm::dvec2& point) { return 0.5 * texels * glm::length(point) < most; });
      };
      const double rim = 0.9 * singularValues(shape).x;
      double sum = 0.0;
      for (const float value : runGlsl(Pcf(), light, views, outside, places))
      {
        const double lit = value * poissonPoints;
        sum += lit;
        EXPECT_NEAR(lit, std::round(lit), 1e-4);
        EXPECT_GE(lit + 1e-3, within(radius - rim)) << radius;
        EXPECT_LE(lit - 1e-3, within(radius + rim)) << radius;
      }
      EXPECT_NEAR(sum / 64.0, within(radius), 0.1 * poissonPoints) << radius;
    }
  }
}

TEST_F(KernelShapeGlsl, aBoxOfAnyWidthHasOneLevelMoreThanTaps)
{
  // The survey's offset scale: the taps of a box lie farther apart than texels.
  const Map halfPlane = [](const glm::ivec2& texel) { return texel.x >= mapSize / 2; };
  for (const int texels : { 1, 3, 5, 11 })
  {
    for (const double scale : { 0.5, 1.0, 3.0 })
    {
      ShadowLight light = filteredSun("box", texels);
      const double texelAcross = 1.0 / mostTexelsAcross(sunViews(light), mapSize);
      light.kernel.widthAcross = scale * texels * texelAcross;
      std::vector<glm::dvec2> places;
      for (int i = 0; i < 6400; ++i)
      {
        places.emplace_back(0.01 * i, 32.3);
      }
      const std::vector<float> values = runGlsl(Pcf(), light, sunViews(light), halfPlane, places);
      std::vector<float> levels = values;
      std::sort(levels.begin(), levels.end());
      levels.erase(std::unique(levels.begin(), levels.end(),
                     [](float a, float b) { return std::abs(a - b) < 1e-5f; }),
        levels.end());
      EXPECT_EQ(levels.size(), static_cast<std::size_t>(texels) + 1)
        << texels << " taps, " << scale;
    }
  }
}

// The points of kernels and of soft shadows, and how far these reach.

TEST(PoissonDisc, isEvenlyScattered)
{
  const auto& points = poissonDisc();
  double least = 2.0;
  glm::dvec2 middle(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LE(glm::length(points[i]), 1.0);
    middle += points[i] / static_cast<double>(points.size());
    for (std::size_t j = 0; j < i; ++j)
    {
      least = std::min(least, glm::distance(points[i], points[j]));
    }
  }
  EXPECT_GE(least, 0.8 * 0.476);
  EXPECT_LT(glm::length(middle), 0.1);
}

TEST(JitteredDiscs, beginWithTheirRings)
{
  for (const int grid : { 2, 8, 11, 16 })
  {
    const std::vector<glm::vec2> points = jitteredDiscs(grid, 16);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(16 * grid * grid));
    glm::dvec2 middle(0.0);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto within = static_cast<int>(i) % (grid * grid);
      EXPECT_LE(glm::length(points[i]), 1.0 + 1e-6);
      middle += glm::dvec2(points[i]) / static_cast<double>(points.size());
      if (within < grid)
      {
        EXPECT_GE(glm::length(points[i]), std::sqrt((grid - 1.0) / grid) - 1e-6);
        const double part = std::atan2(points[i].y, points[i].x) / glm::radians(360.0);
        EXPECT_EQ(static_cast<int>((part < 0.0 ? part + 1.0 : part) * grid), within);
      }
    }
    EXPECT_LT(glm::length(middle), 1.5 / std::sqrt(points.size()));
  }
}

TEST(JitteredDiscs, straightEdgesAreTrueToAFewHundredths)
{
  // Survey, 2.7: 0.0215 for 8 x 8, 0.0135 for 11 x 11, 0.0077 for 16 x 16; the ring adds nothing.
  const double most[3] = { 0.024, 0.0155, 0.0095 };
  const int grids[3] = { 8, 11, 16 };
  for (int k = 0; k < 3; ++k)
  {
    const int grid = grids[k];
    const int points = grid * grid;
    const std::vector<glm::vec2> discs = jitteredDiscs(grid, 256);
    double squares = 0.0;
    double squaresOfRing = 0.0;
    int count = 0;
    for (int disc = 0; disc < 256; ++disc)
    {
      for (int i = -9; i <= 9; ++i, ++count)
      {
        const double edge = 0.1 * i;
        const auto left = [&](int number)
        {
          return std::count_if(discs.begin() + disc * points,
            discs.begin() + disc * points + number,
            [&](const glm::vec2& point) { return point.x < edge; });
        };
        const double all = static_cast<double>(left(points)) / points;
        const double ring = static_cast<double>(left(grid)) / grid;
        const double early = ring == 0.0 || ring == 1.0 ? ring : all;
        squares += std::pow(all - diskShare(edge), 2);
        squaresOfRing += std::pow(early - diskShare(edge), 2);
      }
    }
    const double rms = std::sqrt(squares / count);
    const double rmsOfRing = std::sqrt(squaresOfRing / count);
    RecordProperty(
      "rms" + std::to_string(grid), std::to_string(rms) + " " + std::to_string(rmsOfRing));
    EXPECT_LE(rms, most[k]) << grid;
    EXPECT_LE(rmsOfRing, most[k]) << grid;
  }
}

TEST(Pcss, pointsKeepTheirDistance)
{
  for (const int count : { 16, 36, 64, 256, 512 })
  {
    const std::vector<glm::dvec2> points = poissonSquare(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    double least = 2.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_LE(std::max(std::abs(points[i].x), std::abs(points[i].y)), 1.0);
      for (std::size_t j = 0; j < i; ++j)
      {
        least = std::min(least, wrappedDistance(points[i], points[j]));
      }
    }
    // Random points have 0.1 of it for 16 points, 0.02 for 256.
    EXPECT_GE(least, 0.69 * largestPoissonDistance(count)) << count;
    EXPECT_LE(least, largestPoissonDistance(count)) << count;
  }
}

TEST(Pcss, pointsOfADiskFillItEvenly)
{
  // Apelles, table 4.1.
  for (const auto& [samples, ofPreset] : { std::pair(PcssSamples::Low, std::pair(16, 16)),
         { PcssSamples::Medium, { 36, 64 } }, { PcssSamples::High, { 64, 256 } } })
  {
    const std::vector<glm::vec2> points = pcssPoints(samples, LightArea::Shape::Disk);
    const PcssCounts counts = pcssCounts(samples);
    EXPECT_EQ(std::pair(counts.search, counts.filter), ofPreset);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(counts.search + counts.filter));
    // Four rings of equal area: chi-square with 3 degrees of freedom. Random points exceed it once
    // in twenty times.
    double chiSquare = 0.0;
    const double expected = 0.25 * counts.filter;
    std::vector<int> rings(4, 0);
    for (std::size_t i = static_cast<std::size_t>(counts.search); i < points.size(); ++i)
    {
      const double radius = glm::length(points[i]);
      ASSERT_LE(radius, 1.0 + 1e-6);
      ++rings[static_cast<std::size_t>(std::min(3.0, 4.0 * radius * radius))];
    }
    for (const int ring : rings)
    {
      chiSquare += (ring - expected) * (ring - expected) / expected;
    }
    EXPECT_LT(chiSquare, 7.8);
  }
}

TEST(Pcss, widthsAreThoseOfSimilarTriangles)
{
  // Selected Real-Time Shadow Techniques, 2.9: a light of width 1, a receiver at 10 and a blocker
  // at 5; a frustum that is 10 wide at the near plane 1. There the penumbra is 0.1 of the map's
  // plane, the filter 0.01.
  ShadowLight light = withArea(spotLight({ 0.0, 0.0, 10.0 }, glm::dvec3(0.0), 50.0),
    rectangleArea({ 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, glm::dvec2(0.5)));
  const Bounds casters{ { -1.0, -1.0, 5.0 }, { 1.0, 1.0, 5.0 } };
  const Bounds receivers{ { -5.0, -5.0, 0.0 }, glm::dvec3(5.0) };
  LightViews views = fitLightViews(light, { glm::dvec3(0.0), casters, {}, { 1024, 1 }, {} });
  // Half the light's diagonal times 1/5 - 1/10. Distances are cut 0.1 % short, so rounding removes
  // no caster.
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 0.1, 2e-4);
  EXPECT_EQ(reachOfArea(LightArea(), views, casters, receivers), 0.0);
  light.kind = LightKind::Directional;
  views = fitLightViews(light, { glm::dvec3(0.0), casters, {}, { 1024, 1 }, {} });
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 5.0, 1e-3);
  // Nothing is nearer to a point light than the casters' box, wherever its faces' planes cut.
  light.kind = LightKind::Point;
  const Bounds wide{ glm::dvec3(-4.0), glm::dvec3(4.0) };
  views = fitLightViews(light, { glm::dvec3(0.0), wide, {}, { 1024, 1 }, {} });
  EXPECT_LT(reachOfArea(ballArea(0.3), views, wide, receivers), 0.3);
}

// The moments of a depth in GLSL, and sums of them. FiltersTest has the pictures.

/// Powers are means over two depths. Exponentials spread by their slope, up to their size.
TEST_F(GlslTest, momentsOfADepthAreMeansOverItsSpread)
{
  std::vector<glm::vec2> inputs;
  for (const float depth : { 1.0f, -1.0f, -0.6f, 0.0f, 0.8f })
  {
    for (const float spread : { 0.0f, 1e-3f, 0.01f, 0.1f, 1.0f })
    {
      inputs.emplace_back(depth, spread);
    }
  }
  ShaderLibrary library;
  for (const MomentEstimator& estimator :
    { variance(), fourMoments(), singleExponential(), exponential() })
  {
    const auto answers = runCompute<glm::vec4>(library,
      computeGlsl(ShaderLibrary::source(estimator.momentsFile), "vec2", "vec4",
        "result[i] = momentsOf(given[i].x, given[i].y);\n"),
      inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
    {
      const double depth = inputs[i].x;
      const double spread = inputs[i].y;
      const auto power = [&](int n)
      { return 0.5 * (std::pow(depth - spread, n) + std::pow(depth + spread, n)); };
      const double positive = std::exp(exponentPositive * depth);
      const double negative = -std::exp(-exponentNegative * depth);
      const auto squared = [&](double exponent)
      { return std::pow(std::min(exponent * spread, 1.0), 2); };
      const std::string& name = estimator.info.name;
      const glm::dvec4 expected = name == "single_exponential"
        ? glm::dvec4(positive * (1.0 + 0.5 * squared(exponentPositive)), 0.0, 0.0, 0.0)
        : name == "exponential"
        ? glm::dvec4(positive, positive * positive * (1.0 + squared(exponentPositive)), negative,
            negative * negative * (1.0 + squared(exponentNegative)))
        : glm::dvec4(power(1), power(2), power(3), power(4));
      for (int channel = 0; channel < estimator.count; ++channel)
      {
        const double tolerance = 1e-6 + 1e-4 * std::abs(expected[channel]);
        EXPECT_NEAR(answers[i][channel], expected[channel], tolerance) << name << channel;
        EXPECT_TRUE(i > 0 || std::abs(estimator.empty[channel] - expected[channel]) <= tolerance)
          << "without casters, depth 1";
      }
    }
  }
}

/// The mean over any rectangle of a large map is its texels' value, if they are alike and so all
/// rounded the same way. Floats would lose a thousandth of it.
TEST_F(GlslTest, summedAreaTablesOfLargeMapsLoseNoDigits)
{
  constexpr int size = 1024;
  const glm::vec4 value(0.8123457f, 0.65990554f, 0.3f, 0.7f);
  const std::vector<glm::vec4> texels(size * size, value);
  GlTexture texture;
  fillTexture(texture, GL_RGBA, { size, size, 1 }, texels.data());
  ShaderLibrary library;
  for (const float width : { 1.0f, 9.0f, 128.0f })
  {
    SummedAreaTable table;
    table.allocate(4, size, 1);
    table.setUnits({ 1.0f, 2.0f, 4.0f, 8.0f }, width);
    table.sum(texture.name(), 0, 0, library);
    std::vector<glm::vec4> rectangles; // lower corners and upper ones
    for (int i = 0; i < 200; ++i)
    {
      const glm::vec2 lower(4.4375f * i, 880.0f - 4.1875f * i); // float-exact sixteenths
      rectangles.emplace_back(lower, lower + width);
    }
    const auto means = runCompute<glm::vec4>(library,
      computeGlsl(ShaderLibrary::source("shadowtech/moment_map/summed_area.glsl"), "vec4", "vec4",
        "result[i] = meanOver_LIGHT(given[i].xy, given[i].zw, 0);\n"),
      rectangles, table.uniforms(glm::vec4(0.0f)));
    for (const glm::vec4& mean : means)
    {
      const glm::vec4 off = glm::abs(mean / value - 1.0f);
      ASSERT_LT(std::max({ off.x, off.y, off.z, off.w }), 1e-6f) << width;
    }
  }
}

} // namespace
} // namespace gnomon::test
