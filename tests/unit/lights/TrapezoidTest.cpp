#include "FittedViews.h"

#include "lights/MapWarp.h"
#include "lights/Trapezoid.h"

namespace gnomon::test
{
namespace
{

glm::dmat3 trapezoidOf(const Setting& setting)
{
  return trapezoidFromAcross(setting.body().vertices(), setting.camera, setting.rays);
}

glm::dmat3 uniformOf(const Setting& setting)
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
  ASSERT_NE(map, uniformOf(setting));
  const Rectangle range = rangeOf(map, across);
  EXPECT_LT(glm::length(range.lower + 1.0), 1e-9);
  EXPECT_LT(glm::length(range.upper - 1.0), 1e-9);
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
      EXPECT_EQ(trapezoidOf(setting), uniformOf(setting));
    }
  }
}

TEST(Trapezoid, IsUniformForAParallelCamera)
{
  Setting setting = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  setting.camera.clipFromView = glm::ortho(-10.0, 10.0, -10.0, 10.0, 0.0, 3000.0);
  EXPECT_EQ(trapezoidOf(setting), uniformOf(setting));
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
      0.15 * worstTexel(ground, setting, uniformOf(setting)));
  }
}

TEST(Trapezoid, HasNoLargerTexelsThanUniform)
{
  expectNoLargerTexels(trapezoidFromAcross, 8);
}

} // namespace
} // namespace gnomon::test
