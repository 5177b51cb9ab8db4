#include "FittedViews.h"

#include "lights/Lispsm.h"
#include "lights/Splits.h"

namespace gnomon::test
{
namespace
{

glm::dmat3 lispsmOf(const Setting& setting)
{
  return lispsmFromAcross(setting.body().vertices(), setting.camera, setting.rays);
}

glm::dmat3 uniformOf(const Setting& setting)
{
  return uniformFromAcross(setting.rays.across(setting.body().vertices()));
}

void expectEqual(const glm::dmat3& a, const glm::dmat3& b, double tolerance)
{
  for (int column = 0; column < 3; ++column)
  {
    EXPECT_LT(glm::length(a[column] - b[column]), tolerance);
  }
}

TEST(Lispsm, NearDistanceIsThePublishedOptimum)
{
  for (const double f : { 1.5, 10.0, 1e4 })
  {
    EXPECT_NEAR(lispsmOptimum(f) * (f - 1.0), 1.0 + std::sqrt(f), 1e-9 * f);
  }
}

TEST(Lispsm, IsSoundForAnyCameraAndLight)
{
  expectSoundProjections(lispsmFromAcross, 101);
}

/// Survey, row 31: near-plane texel density gain against uniform, for a grazing view.
TEST(Lispsm, HasMoreTexelsNearTheCamera)
{
  const Setting setting = terrain(directionalRays({ 0.3, 0.0, -1.0 }));
  std::vector<SurfacePoint> nearest;
  for (const SurfacePoint& point : groundSeen(setting))
  {
    if (distanceOf(setting.camera, point.positionCentred) < 40.0)
    {
      nearest.push_back(point);
    }
  }
  ASSERT_GT(nearest.size(), 10u);
  const double gain = worstTexel(nearest, setting, uniformOf(setting)) /
    worstTexel(nearest, setting, lispsmOf(setting));
  RecordProperty("gain", std::to_string(gain));
  EXPECT_GT(gain, 2.0);
}

TEST(Lispsm, IsUniformForLightAlongTheViewEitherWay)
{
  const Setting plain = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  const glm::dvec3 view = plain.camera.directionCentred();
  for (const double sign : { 1.0, -1.0 })
  {
    for (const double degrees : { 0.0, 1e-7, 1e-3, 1.0, 5.0 })
    {
      const double angle = glm::radians(degrees);
      const glm::dvec3 aside(1.0, 0.0, 0.0);
      const Setting setting =
        terrain(directionalRays(sign * (std::cos(angle) * view + std::sin(angle) * aside)));
      expectEqual(lispsmOf(setting), uniformOf(setting), 1e-4);
    }
  }
}

TEST(Lispsm, IsNoWorseThanUniformForAnyLight)
{
  expectHardlyWorseThanUniform(lispsmFromAcross, 1.0);
}

TEST(Lispsm, SpreadsTheTexelsOverATerrain)
{
  for (const glm::dvec3& light : { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, -1.0),
         glm::dvec3(0.0, 1.0, -1.0), glm::dvec3(0.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, -0.4) })
  {
    const Setting setting = terrain(directionalRays(light));
    const auto ground = groundSeen(setting);
    const double uniform = worstTexel(ground, setting, uniformOf(setting));
    EXPECT_LE(worstTexel(ground, setting, lispsmOf(setting)), 0.1 * uniform);

    const ConvexBody body = setting.body();
    const DistanceRange all = distancesOf(body.vertices(), setting.camera, setting.rays);
    const auto splits = splitDistances({ all.lower, all.upper }, 4, 0.5);
    double split = 0.0;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i)
    {
      std::vector<SurfacePoint> points;
      for (const SurfacePoint& point : ground)
      {
        const double distance = distanceOf(setting.camera, point.positionCentred);
        if (splits[i] <= distance && distance <= splits[i + 1])
        {
          points.push_back(point);
        }
      }
      const Points slice =
        sliced(body, setting.camera, setting.rays, splits[i], splits[i + 1]).vertices();
      split =
        std::max(split, worstTexel(points, setting, uniformFromAcross(setting.rays.across(slice))));
    }
    EXPECT_LE(split, 0.25 * uniform);
  }
}

TEST(Lispsm, SpreadsTheTexelsOfASpotLight)
{
  for (const LightRays& rays : { spotRays({ 0.0, 0.0, 1500.0 }, { 0.0, 0.0, -1.0 }),
         spotRays({ 500.0, -700.0, 200.0 }, { -1.0, 0.3, -0.5 }),
         spotRays({ 0.0, -1000.0, 200.0 }, { 0.0, 1.0, -0.5 }),
         spotRays({ 0.0, 0.0, 200.0 }, { 0.0, -1.0, -0.5 }) })
  {
    Setting setting = terrain(rays);
    setting.reach = coneHalfSpaces(std::tan(glm::radians(50.0)), nearestOf(setting.scene, rays));
    const auto ground = groundSeen(setting);
    ASSERT_GT(ground.size(), 100u);
    EXPECT_LE(worstTexel(ground, setting, lispsmOf(setting)),
      0.25 * worstTexel(ground, setting, uniformOf(setting)));
  }
}

TEST(Lispsm, HasNoLargerTexelsThanUniform)
{
  expectNoLargerTexels(lispsmFromAcross, 7);
}

} // namespace
} // namespace gnomon::test
