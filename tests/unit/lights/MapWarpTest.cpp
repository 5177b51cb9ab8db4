#include "FittedViews.h"

#include "lights/Lispsm.h"
#include "lights/MapWarp.h"

namespace gnomon::test
{
namespace
{

std::optional<WarpFrame> frameOf(const Setting& setting)
{
  return warpFrame(setting.body().vertices(), setting.camera, setting.rays);
}

TEST(MapWarp, LooksAlongTheCamerasAxisAsTheLightSeesIt)
{
  for (const LightRays& rays : { directionalRays({ 0.5, 0.2, -1.0 }),
         spotRays({ 300.0, -500.0, 600.0 }, { -0.2, 0.1, -1.0 }) })
  {
    Setting setting = terrain(rays);
    if (rays.positional)
    {
      setting.reach = coneHalfSpaces(2.0, nearestOf(setting.scene, rays));
    }
    const auto frame = frameOf(setting);
    ASSERT_TRUE(frame);
    double before = -1e300;
    for (const double distance : { 2.0, 10.0, 100.0, 800.0 })
    {
      const glm::dvec3 centred =
        setting.camera.eyeCentred() + distance * setting.camera.directionCentred();
      const glm::dvec2 place = mapped(frame->frameFromAcross, rays.across(inView(rays, centred)));
      EXPECT_NEAR(place.x, 0.0, 1e-9 * frame->depth);
      EXPECT_GT(place.y, before);
      before = place.y;
    }
    const Rectangle range = rangeOf(frame->frameFromAcross, rays.across(setting.body().vertices()));
    EXPECT_NEAR(range.lower.y, 0.0, 1e-12 * frame->depth);
    EXPECT_NEAR(range.upper.y, frame->depth, 1e-12 * frame->depth);
    EXPECT_NEAR(frame->nearest, 1.0, 1e-9);
    EXPECT_NEAR(glm::determinant(frame->frameFromAcross), 1.0, 1e-12);
  }
}

TEST(MapWarp, KnowsTheAnglesOfLightAndView)
{
  const double tilt = glm::degrees(std::atan2(10.0, 900.0));
  const auto above = frameOf(terrain(directionalRays({ 0.0, 0.0, -1.0 })));
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->gammaDegrees, 90.0 - tilt, 1e-9);
  EXPECT_NEAR(above->thetaDegrees, 20.0, 1e-9);
  const auto against = frameOf(terrain(directionalRays({ 0.0, -1.0, -1.0 })));
  ASSERT_TRUE(against);
  EXPECT_NEAR(against->gammaDegrees, 135.0 - tilt, 1e-9);
}

TEST(MapWarp, IsRefusedWithoutPerspectiveOrDepth)
{
  const LightRays above = directionalRays({ 0.0, 0.0, -1.0 });
  Setting parallel = terrain(above);
  parallel.camera.clipFromView = glm::ortho(-10.0, 10.0, -10.0, 10.0, 0.0, 3000.0);
  EXPECT_FALSE(frameOf(parallel));
  const Setting plain = terrain(above);
  EXPECT_FALSE(frameOf(terrain(directionalRays(plain.camera.directionCentred()))));
  EXPECT_FALSE(frameOf(terrain(directionalRays(-plain.camera.directionCentred()))));
  EXPECT_FALSE(warpFrame({}, plain.camera, plain.rays));
  EXPECT_FALSE(warpFrame({ { 1.0, 2.0, 3.0 } }, plain.camera, plain.rays));
  Setting fromEye = terrain(spotRays(plain.camera.eyeCentred(), { 0.0, 1.0, -0.5 }));
  fromEye.reach = coneHalfSpaces(1.0, nearestOf(fromEye.scene, fromEye.rays));
  ASSERT_FALSE(fromEye.body().empty());
  EXPECT_FALSE(frameOf(fromEye));
  // The body contains a point in the eye's plane.
  Points atEye = plain.body().vertices();
  atEye.push_back(inView(above, plain.camera.eyeCentred()));
  EXPECT_FALSE(warpFrame(atEye, plain.camera, above));
}

TEST(MapWarp, EtaRisesFromNoneToAll)
{
  const double theta = 30.0;
  EXPECT_EQ(warpEta(0.0, theta), -1.0);
  EXPECT_EQ(warpEta(10.0, theta), -1.0);
  EXPECT_NEAR(warpEta(30.0, theta), -0.2, 1e-12);
  EXPECT_NEAR(warpEta(48.0, theta), 0.0, 1e-12);
  EXPECT_EQ(warpEta(90.0, theta), 0.0);
  double before = -1.0;
  for (double gamma = 0.0; gamma <= 90.0; gamma += 0.01)
  {
    const double eta = warpEta(gamma, theta);
    EXPECT_GE(eta, before);
    EXPECT_LT(eta, before + 0.01); // without a jump
    EXPECT_NEAR(warpEta(180.0 - gamma, theta), eta, 1e-9);
    before = eta;
  }
  for (const double narrowOrWide : { 0.0, 1e-9, 89.999, 90.0 })
  {
    for (double gamma = 0.0; gamma <= 180.0; gamma += 1.0)
    {
      EXPECT_GE(warpEta(gamma, narrowOrWide), -1.0);
      EXPECT_LE(warpEta(gamma, narrowOrWide), 0.0);
    }
  }
}

TEST(MapWarp, FallsOffToInfinity)
{
  WarpFrame frame;
  frame.thetaDegrees = 30.0;
  frame.gammaDegrees = 90.0;
  EXPECT_EQ(fallOff(frame, 0.1), 0.1);
  frame.gammaDegrees = 30.0;
  EXPECT_NEAR(fallOff(frame, 0.1), (0.1 + 0.2) / 0.8, 1e-12);
  frame.gammaDegrees = 175.0;
  EXPECT_EQ(fallOff(frame, 0.1), std::numeric_limits<double>::infinity());
}

/// The search finds the value of the published formula for parallel rays across the view.
TEST(MapWarp, OfLeastAliasingIsThePublishedOptimum)
{
  Setting setting;
  setting.scene = { glm::dvec3(-1e6), glm::dvec3(1e6) };
  setting.rays = directionalRays({ 0.0, 0.0, -1.0 });
  for (const double farDistance : { 5.0, 50.0, 1000.0 })
  {
    setting.camera = perspectiveCamera(glm::dvec3(0.0), { 0.0, 1.0, 0.0 }, 60.0, 1.0, farDistance);
    const Points body = setting.body().vertices();
    const auto frame = frameOf(setting);
    ASSERT_TRUE(frame);
    const auto aliasing = [&](double nearWarp)
    {
      const glm::dmat3 map =
        warpedFromAcross(*frame, nearWarp * frame->depth, setting.rays.across(body));
      return perspectiveAliasing(body, setting.camera, setting.rays, map).side;
    };
    const double found = aliasing(leastAliasingNear(*frame, body, setting.camera, setting.rays));
    const double published = aliasing(lispsmOptimum(farDistance));
    EXPECT_LE(found, published * (1.0 + 1e-6));
    EXPECT_GE(found, 0.8 * published);
  }
}

TEST(MapWarp, IsUniformWhereThatIsBetter)
{
  const Setting setting = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  const Points body = setting.body().vertices();
  const auto frame = frameOf(setting);
  ASSERT_TRUE(frame);
  const glm::dmat3 uniform = uniformFromAcross(setting.rays.across(body));
  const auto result = [&](double nearWarp)
  { return warpedOrUniform(*frame, nearWarp, body, setting.camera, setting.rays); };
  EXPECT_NE(result(0.03), uniform);
  EXPECT_EQ(result(1e-6), uniform); // all of the map for the first millimetres
  EXPECT_EQ(result(1e7), uniform);
  EXPECT_EQ(result(std::numeric_limits<double>::infinity()), uniform);
}

} // namespace
} // namespace gnomon::test
