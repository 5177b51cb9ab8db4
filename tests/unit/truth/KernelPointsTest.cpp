// The points of kernels and of soft shadows, and how far these reach.

#include "HalfPlane.h"
#include "SyntheticScene.h"

#include "lights/Bounds.h"
#include "lights/LightViews.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/depth_map/KernelPoints.h"
#include "shadowtech/depth_map/PcssPoints.h"

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

} // namespace
} // namespace gnomon::test
