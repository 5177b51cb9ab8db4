// LiSPSM and trapezoidal maps, each against the uniform map of the same camera and light.

#include "FittedViews.h"

#include "lights/Lispsm.h"
#include "lights/MapWarp.h"
#include "lights/Trapezoid.h"

#include <ostream>

namespace gnomon::test
{
namespace
{

/// A warp, and what it is good for.
struct Warp
{
  const char* name;
  glm::dmat3 (*fromAcross)(const Points& body, const CameraView& camera, const LightRays& rays);
  double worstRatio;    ///< of its texels to those of the uniform map, from any direction
  double terrainRatio;  ///< the same on a terrain under usual lights
  double uniformWithin; ///< how near it is to the uniform map for light along the view
};
std::ostream& operator<<(std::ostream& stream, const Warp& warp)
{
  return stream << warp.name;
}

const glm::dvec3 usualLights[] = { { 0.0, 0.0, -1.0 }, { 1.0, 0.0, -1.0 }, { 0.0, 1.0, -1.0 },
  { 0.0, -1.0, -1.0 }, { 1.0, 1.0, -0.4 } };

glm::dmat3 uniformOf(const Setting& setting)
{
  return uniformFromAcross(setting.rays.across(setting.body().vertices()));
}

class WarpedProjections : public testing::TestWithParam<Warp>
{
protected:
  static glm::dmat3 warpOf(const Setting& setting)
  {
    return GetParam().fromAcross(setting.body().vertices(), setting.camera, setting.rays);
  }
  static void expectUniform(const Setting& setting)
  {
    const glm::dmat3 warp = warpOf(setting), uniform = uniformOf(setting);
    for (int column = 0; column < 3; ++column)
    {
      EXPECT_LE(glm::length(warp[column] - uniform[column]), GetParam().uniformWithin);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Of, WarpedProjections,
  testing::Values(Warp{ "lispsm", lispsmFromAcross, 1.0, 0.1, 1e-4 },
    Warp{ "trapezoid", trapezoidFromAcross, 1.25, 0.15, 0.0 }),
  [](const testing::TestParamInfo<Warp>& warp) { return std::string(warp.param.name); });

/// They are finite, have no horizon or flip over the body, map all visible points onto the map, and
/// their worst texel is no larger than that of the uniform map.
TEST_P(WarpedProjections, areSoundForAnyCameraAndLight)
{
  Random random(101);
  int bodies = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Setting setting = randomSetting(random);
    SCOPED_TRACE(setting.name + ", number " + std::to_string(i));
    const Points body = setting.body().vertices();
    const glm::dmat3 map = warpOf(setting);
    for (int column = 0; column < 3; ++column)
    {
      ASSERT_TRUE(glm::all(glm::lessThan(glm::abs(map[column]), glm::dvec3(1e300))));
    }
    ASSERT_GT(glm::determinant(map), 0.0);
    if (body.empty())
    {
      continue;
    }
    ++bodies;
    Points points = body;
    for (const glm::dvec3& centred : setting.visiblePoints(random, 100))
    {
      points.push_back(inView(setting.rays, centred));
    }
    for (const glm::dvec3& view : points)
    {
      const glm::dvec3 image = map * glm::dvec3(setting.rays.across(view), 1.0);
      ASSERT_GT(image.z, 0.0);
      ASSERT_LE(std::abs(image.x / image.z), 1.0 + 1e-7);
      ASSERT_LE(std::abs(image.y / image.z), 1.0 + 1e-7);
    }
    const auto area = [&](const glm::dmat3& of)
    { return perspectiveAliasing(body, setting.camera, setting.rays, of).area; };
    EXPECT_LE(area(map), area(uniformOf(setting)));
  }
  EXPECT_GT(bodies, 500); // enough of them see something
}

TEST_P(WarpedProjections, areUniformForLightAlongTheViewEitherWay)
{
  const Setting plain = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  const glm::dvec3 view = plain.camera.directionCentred();
  for (const double sign : { 1.0, -1.0 })
  {
    for (const double degrees : { 0.0, 1e-7, 1e-3, 1.0, 2.8 })
    {
      const double angle = glm::radians(degrees);
      for (const glm::dvec3& aside : { glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0) })
      {
        expectUniform(
          terrain(directionalRays(sign * (std::cos(angle) * view + std::sin(angle) * aside))));
      }
    }
  }
  Setting parallel = plain;
  parallel.camera.clipFromView = glm::ortho(-10.0, 10.0, -10.0, 10.0, 0.0, 3000.0);
  expectUniform(parallel);
}

/// The light comes from all directions at more than three degrees above the ground.
TEST_P(WarpedProjections, areHardlyWorseThanUniformForAnyLight)
{
  for (const double height : { 10.0, 100.0, 300.0 })
  {
    Setting setting = terrain({});
    setting.camera =
      perspectiveCamera({ 0.0, -900.0, height }, { 0.0, 0.0, 0.0 }, 40.0, 1.0, 3000.0);
    const auto ground = groundSeen(setting);
    const glm::dvec3 view = setting.camera.directionCentred(), right(1.0, 0.0, 0.0);
    for (const double gamma : { 0.0, 1e-6, 0.5, 2.0, 5.0, 7.0, 8.5, 10.0, 12.5, 15.0, 17.5, 20.0,
           22.5, 25.0, 30.0, 37.5, 45.0, 60.0, 75.0, 90.0 })
    {
      for (int around = 0; around < 32; ++around)
      {
        const double azimuth = glm::radians(22.5 * around), angle = glm::radians(gamma);
        const glm::dvec3 light = std::cos(angle) * view +
          std::sin(angle) *
            (std::cos(azimuth) * right + std::sin(azimuth) * glm::cross(right, view));
        if (std::abs(light.z) > std::sin(glm::radians(3.0)))
        {
          setting.rays = directionalRays(around < 16 ? light : -light);
          EXPECT_LE(worstTexel(ground, setting, warpOf(setting)),
            GetParam().worstRatio * worstTexel(ground, setting, uniformOf(setting)))
            << "height " << height << ", gamma " << gamma << ", azimuth " << 22.5 * around;
        }
      }
    }
  }
}

TEST_P(WarpedProjections, spreadTheTexelsOverATerrain)
{
  for (const glm::dvec3& light : usualLights)
  {
    const Setting setting = terrain(directionalRays(light));
    const auto ground = groundSeen(setting);
    EXPECT_LE(worstTexel(ground, setting, warpOf(setting)),
      GetParam().terrainRatio * worstTexel(ground, setting, uniformOf(setting)));
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
    EXPECT_LE(worstTexel(ground, setting,
                lispsmFromAcross(setting.body().vertices(), setting.camera, setting.rays)),
      0.25 * worstTexel(ground, setting, uniformOf(setting)));
  }
}

TEST(Trapezoid, TakesTheCornersOfTheTrapezoidToThoseOfTheMap)
{
  // Construct the trapezoid by separate geometry. Parallel sides lie across the centre line; the
  // legs start at a point on it before the near side and touch the visible body.
  for (const glm::dvec3& light : { usualLights[0], usualLights[1], usualLights[2], usualLights[3] })
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
    const glm::dmat3 map = trapezoidFromAcross(body, setting.camera, setting.rays);
    ASSERT_NE(map, uniformOf(setting));
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

} // namespace
} // namespace gnomon::test
