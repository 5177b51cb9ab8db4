#include "FittedViews.h"

#include "lights/MapWarp.h"
#include "lights/Trapezoid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::test
{
namespace
{

glm::dmat3 trapezoidOf(const Setting& setting)
{
  return trapezoidFromAcross(setting.body().vertices(), setting.camera, setting.rays);
}

glm::dmat3 uniformUnderTrapezoid(const Setting& setting)
{
  return uniformFromAcross(setting.rays.across(setting.body().vertices()));
}

TEST(Trapezoid, GivesTheFocusRegionEightyPercentOfTheMap)
{
  const Setting setting = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  const Points body = setting.body().vertices();
  const DistanceRange all = distancesOf(body, setting.camera, setting.rays);
  const double focus = all.lower * std::pow(all.upper / all.lower, 0.8);
  const glm::dvec3 point = setting.camera.eyeCentred() + focus * setting.camera.directionCentred();
  const glm::dmat3 map = trapezoidOf(setting);
  EXPECT_NEAR(mapped(map, setting.rays.across(inView(setting.rays, point))).y, 0.6, 1e-6);
}

TEST(Trapezoid, TouchesAllSidesOfTheMap)
{
  const Setting setting = terrain(directionalRays({ 0.4, 0.3, -1.0 }));
  const auto across = setting.rays.across(setting.body().vertices());
  const glm::dmat3 map = trapezoidOf(setting);
  ASSERT_NE(map, uniformUnderTrapezoid(setting));
  const Rectangle range = rangeOf(map, across);
  EXPECT_LT(glm::length(range.lower + 1.0), 1e-9);
  EXPECT_LT(glm::length(range.upper - 1.0), 1e-9);
}

TEST(Trapezoid, TakesTheCornersOfTheTrapezoidToThoseOfTheMap)
{
  // Construct the trapezoid by separate geometry. Parallel sides lie across the centre line; the
  // legs start at a point on it before the near side and touch the visible body.
  for (const glm::dvec3& light : { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, -1.0),
         glm::dvec3(0.0, 1.0, -1.0), glm::dvec3(0.0, -1.0, -1.0) })
  {
    const Setting setting = terrain(directionalRays(light));
    const Points body = setting.body().vertices();
    const DistanceRange all = distancesOf(body, setting.camera, setting.rays);
    const auto onAxis = [&](double distance)
    {
      const glm::dvec3 point =
        setting.camera.eyeCentred() + distance * setting.camera.directionCentred();
      return glm::dvec2(setting.rays.across(inView(setting.rays, point)));
    };
    const glm::dvec2 along = glm::normalize(onAxis(all.upper) - onAxis(all.lower));
    const glm::dvec2 right(along.y, -along.x);
    double nearSide = std::numeric_limits<double>::infinity(), farSide = -nearSide;
    for (const glm::dvec2& point : setting.rays.across(body))
    {
      nearSide = std::min(nearSide, glm::dot(point, along));
      farSide = std::max(farSide, glm::dot(point, along));
    }
    // Martin and Tan, section 5.2, with the focus on the line xi = -0.6 of a map whose near side is
    // at 1.
    const double lambda = farSide - nearSide;
    const double delta =
      glm::dot(onAxis(all.lower * std::pow(all.upper / all.lower, 0.8)), along) - nearSide;
    const double xi = -0.6;
    const double before = lambda * delta * (1.0 + xi) / (lambda - 2.0 * delta - lambda * xi);
    const double centreLine = glm::dot(onAxis(all.lower), right);
    double leftLeg = std::numeric_limits<double>::infinity(), rightLeg = -leftLeg;
    for (const glm::dvec2& point : setting.rays.across(body))
    {
      const double slope =
        (glm::dot(point, right) - centreLine) / (glm::dot(point, along) - nearSide + before);
      leftLeg = std::min(leftLeg, slope);
      rightLeg = std::max(rightLeg, slope);
    }
    const glm::dmat3 map = trapezoidOf(setting);
    ASSERT_NE(map, uniformUnderTrapezoid(setting));
    for (const double x : { -1.0, 1.0 })
    {
      for (const double y : { -1.0, 1.0 })
      {
        const double from = y < 0.0 ? before : before + lambda; // the point where the legs meet
        const glm::dvec2 corner = (centreLine + from * (x < 0.0 ? leftLeg : rightLeg)) * right +
          (nearSide - before + from) * along;
        EXPECT_LT(glm::length(mapped(map, corner) - glm::dvec2(x, y)), 1e-6);
      }
    }
  }
}

TEST(Trapezoid, IsSoundForAnyCameraAndLight)
{
  expectSoundProjections(trapezoidFromAcross, 102);
}

TEST(Trapezoid, IsUniformForLightAlongTheViewEitherWay)
{
  const Setting plain = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  for (const double sign : { 1.0, -1.0 })
  {
    const glm::dvec3 view = sign * plain.camera.directionCentred();
    for (const glm::dvec3& aside : { glm::dvec3(0.0), glm::dvec3(1e-8, 0.0, 0.0),
           glm::dvec3(0.05, 0.0, 0.0), glm::dvec3(0.0, 0.0, 0.05) })
    {
      const Setting setting = terrain(directionalRays(view + aside));
      EXPECT_EQ(trapezoidOf(setting), uniformUnderTrapezoid(setting));
    }
  }
}

TEST(Trapezoid, IsUniformForAParallelCamera)
{
  Setting setting = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  setting.camera.clipFromView = glm::ortho(-10.0, 10.0, -10.0, 10.0, 0.0, 3000.0);
  EXPECT_EQ(trapezoidOf(setting), uniformUnderTrapezoid(setting));
}

TEST(Trapezoid, IsHardlyWorseThanUniformForAnyLight)
{
  expectHardlyWorseThanUniform(trapezoidFromAcross, 1.25);
}

TEST(Trapezoid, SpreadsTheTexelsOverATerrain)
{
  for (const glm::dvec3& light : { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, -1.0),
         glm::dvec3(0.0, 1.0, -1.0), glm::dvec3(0.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, -0.4) })
  {
    const Setting setting = terrain(directionalRays(light));
    const auto ground = groundSeen(setting);
    EXPECT_LE(worstTexel(ground, setting, trapezoidOf(setting)),
      0.15 * worstTexel(ground, setting, uniformUnderTrapezoid(setting)));
  }
}

TEST(Trapezoid, HasNoLargerTexelsThanUniform)
{
  expectNoLargerTexels(trapezoidFromAcross, 8);
}

} // namespace
} // namespace gnomon::test
