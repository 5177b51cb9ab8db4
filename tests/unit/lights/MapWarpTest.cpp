#include "FittedViews.h"
#include "Random.h"

#include "lights/Lispsm.h"
#include "lights/MapWarp.h"
#include "lights/Splits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::test
{
namespace
{

std::optional<WarpFrame> frameOf(const Setting& setting)
{
  return warpFrame(setting.body().vertices(), setting.camera, setting.rays);
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

TEST(MapFit, IsThePublishedScaleAndOffsetClampedToWhatIsToBeCovered)
{
  const auto first = fitTo(Rectangle{ { -0.25, -1.0 }, { 0.5, 1.0 } }, { 1024, 0 });
  const auto clamped = fitTo(Rectangle{ { -5.0, 0.5 }, { 5.0, 7.0 } }, { 64, 0 });
  ASSERT_TRUE(first && clamped);
  EXPECT_LT(glm::distance(first->scale, { 8.0 / 3.0, 1.0 }), 1e-15);
  EXPECT_LT(glm::distance(first->offset, { -1.0 / 3.0, 0.0 }), 1e-15);
  EXPECT_EQ(clamped->scale, glm::dvec2(1.0, 4.0));
  EXPECT_EQ(clamped->offset, glm::dvec2(0.0, -3.0));
}

TEST(MapFit, WidensWhatHasNoExtent)
{
  for (const double at : { -1.0, 0.3, 1.0 })
  {
    const Rectangle point = { glm::dvec2(at), glm::dvec2(at) };
    for (const auto& fit : { fitTo(point, { 64, 1 }), fitSnappedTo(point, { 64, 1 }) })
    {
      ASSERT_TRUE(fit);
      EXPECT_LE(fit->scale.x, 1.0 / leastVisibleShare);
      EXPECT_LE(std::abs(mapped(fit->matrix(), point.lower).x), 1.0 - 2.0 / 64 + 1e-9);
    }
  }
}

TEST(MapFit, SnappedCoversWhatIsVisibleAtAStepOfTheSeries)
{
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    Rectangle visible;
    visible.add(glm::dvec2(inCube(random)));
    visible.add(glm::dvec2(inCube(random)));
    const MapTexels texels{ i % 2 == 0 ? 64 : 1024, i % 4 };
    const auto snapped = fitSnappedTo(visible, texels);
    const auto tight = fitTo(visible, texels);
    ASSERT_TRUE(snapped && tight);
    for (const glm::dvec2& corner : { visible.lower, visible.upper })
    {
      ASSERT_LE(std::abs(mapped(snapped->matrix(), corner).x), texels.inside() + 1e-9);
      ASSERT_LE(std::abs(mapped(snapped->matrix(), corner).y), texels.inside() + 1e-9);
    }
    const double whole = texels.inside() - 1.0 / texels.side;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double step = 4.0 * std::log2(snapped->scale[axis] / whole);
      ASSERT_NEAR(step, std::round(step), 1e-9);
      ASSERT_GE(step, -1e-9);
      const double offset = snapped->offset[axis] * texels.side / 2.0;
      ASSERT_NEAR(offset, std::round(offset), 1e-6);
      // The fit is not much coarser than without snapping.
      ASSERT_GE(
        snapped->scale[axis], tight->scale[axis] * std::exp2(-0.25) * (1.0 - 4.0 / texels.side));
    }
  }
}

/// Apelles, eq. 3.17, for a map whose texels are as wide as the pixels are at distance 1.
TEST(MapAliasing, OfASurfaceAcrossViewAndLightIsOneOverTheDistance)
{
  const LightRays rays = directionalRays({ 0.0, 1.0, 0.0 });
  const CameraView camera = perspectiveCamera(glm::dvec3(0.0), { 0.0, 1.0, 0.0 }, 90.0, 0.1, 100.0);
  for (const double distance : { 0.5, 1.0, 4.0, 50.0 })
  {
    const auto texel = texelPixels({ { 0.0, distance, 0.0 }, { 0.0, -1.0, 0.0 } }, camera,
      { 100.0, 100.0 }, rays, glm::dmat3(1.0), 100);
    ASSERT_TRUE(texel);
    EXPECT_NEAR(texel->x, 1.0 / distance, 1e-12);
    EXPECT_NEAR(texel->y, 1.0 / distance, 1e-12);
    const auto aliasing =
      perspectiveAliasing({ inView(rays, { 0.0, distance, 0.0 }) }, camera, rays, glm::dmat3(1.0));
    EXPECT_NEAR(aliasing.side, 1.0 / distance, 1e-12);
    EXPECT_NEAR(aliasing.area, 1.0 / (distance * distance), 1e-12);
  }
}

TEST(MapAliasing, OfAPositionalLightStandsAcrossItsRay)
{
  // The ray is at 45 degrees along x, so a step of the slope x / z moves at an angle to it.
  const LightRays rays{ glm::dmat4(1.0), true };
  const CameraView camera =
    perspectiveCamera({ 2.0, -5.0, 2.0 }, { 2.0, 0.0, 2.0 }, 60.0, 1.0, 9.0);
  const auto aliasing = [&](const glm::dmat3& map) {
    return perspectiveAliasing({ { 2.0, 0.0, 2.0 } }, camera, rays, map);
  };
  const double root = std::sqrt(0.5);
  EXPECT_NEAR(aliasing(glm::dmat3(1.0)).side, 2.0 / 5.0, 1e-12); // along y
  EXPECT_NEAR(aliasing(glm::dmat3(1.0)).area, root * 4.0 / 25.0, 1e-12);
  const glm::dmat3 fineAlongY(1.0, 0.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 1.0);
  EXPECT_NEAR(aliasing(fineAlongY).side, root * 2.0 / 5.0, 1e-12);
}

TEST(Splits, AreTheSchemesOfThePaper)
{
  const auto uniform = splitDistances({ 1.0, 81.0 }, 4, 0.0);
  const auto logarithmic = splitDistances({ 1.0, 81.0 }, 4, 1.0);
  const auto practical = splitDistances({ 1.0, 81.0 }, 4, 0.25);
  for (std::size_t i = 0; i <= 4; ++i)
  {
    EXPECT_NEAR(uniform[i], 1.0 + 20.0 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(logarithmic[i], std::pow(3.0, static_cast<double>(i)), 1e-12);
    EXPECT_NEAR(practical[i], 0.25 * logarithmic[i] + 0.75 * uniform[i], 1e-12);
  }
}

TEST(Splits, StayFiniteWithoutAPositiveDistance)
{
  for (const DistanceInterval& interval :
    { DistanceInterval{ 0.0, 10.0 }, { -5.0, 10.0 }, { -5.0, -1.0 }, { 0.0, 0.0 }, { 2.0, 2.0 } })
  {
    for (const double lambda : { 0.0, 0.5, 1.0 })
    {
      const auto splits = splitDistances(interval, 8, lambda);
      EXPECT_TRUE(std::is_sorted(splits.begin(), splits.end()));
      EXPECT_EQ(splits.front(), interval.nearest);
      EXPECT_EQ(splits.back(), interval.farthest);
      for (const double distance : splits)
      {
        EXPECT_TRUE(std::isfinite(distance));
      }
    }
  }
}

TEST(CameraView, KnowsItsEyeItsDirectionAndItsPlanes)
{
  const CameraView camera =
    perspectiveCamera({ 1.0, 2.0, 3.0 }, { 1.0, 9.0, 3.0 }, 60.0, 0.5, 20.0);
  EXPECT_LT(glm::length(camera.eyeCentred() - glm::dvec3(1.0, 2.0, 3.0)), 1e-12);
  EXPECT_LT(glm::length(camera.directionCentred() - glm::dvec3(0.0, 1.0, 0.0)), 1e-12);
  EXPECT_NEAR(camera.nearDistance(), 0.5, 1e-12);
  EXPECT_NEAR(camera.farDistance(), 20.0, 1e-9);
  EXPECT_NEAR(distanceOf(camera, { 7.0, 6.0, -2.0 }), 4.0, 1e-12);
  EXPECT_FALSE(camera.isParallel());
  const auto corners = camera.cornersCentred();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    EXPECT_NEAR(distanceOf(camera, corners[i]), i < 4 ? 0.5 : 20.0, 1e-9);
  }

  CameraView parallel = camera;
  parallel.clipFromView = glm::ortho(-1.0, 1.0, -1.0, 1.0, -2.0, 20.0);
  EXPECT_TRUE(parallel.isParallel());
  EXPECT_NEAR(parallel.nearDistance(), -2.0, 1e-12);
  EXPECT_NEAR(parallel.farDistance(), 20.0, 1e-12);

  CameraView infinite = camera;
  infinite.clipFromView = glm::infinitePerspective(1.0, 1.0, 0.5);
  EXPECT_NEAR(infinite.nearDistance(), 0.5, 1e-12);
  EXPECT_EQ(infinite.farDistance(), std::numeric_limits<double>::infinity());
}

TEST(ConvexBody, OfHalfSpacesThatLeaveAllOrNothing)
{
  const ConvexBody box({ glm::dvec3(-1.0), glm::dvec3(1.0) }, glm::dmat4(1.0));
  EXPECT_EQ(box.clipped({ 1.0, 0.0, 0.0, 5.0 }).vertices().size(), 8u);
  EXPECT_EQ(box.clipped({ 0.0, 0.0, 0.0, 1.0 }).vertices().size(), 8u);
  EXPECT_EQ(box.clipped({ 0.0, 0.0, 0.0, 0.0 }).vertices().size(), 8u);
  EXPECT_TRUE(box.clipped({ 0.0, 0.0, 0.0, -1.0 }).empty());
  EXPECT_TRUE(box.clipped({ 1.0, 0.0, 0.0, -5.0 }).empty());
  EXPECT_TRUE(box.clipped({ 1.0, 0.0, 0.0, std::nan("") }).empty());
  EXPECT_EQ(box.clipped({ 1.0, 0.0, 0.0, -1.0 }).vertices().size(), 4u); // a face alone
  EXPECT_TRUE(ConvexBody().clipped({ 1.0, 0.0, 0.0, 5.0 }).empty());
  EXPECT_TRUE(ConvexBody(Bounds(), glm::dmat4(1.0)).vertices().empty());
  EXPECT_TRUE(ConvexBody({ glm::dvec3(0.0), glm::dvec3(1.0) }, glm::dmat4(std::nan(""))).empty());
}

TEST(VisibleBody, HoldsAllThatIsVisibleAndNoMore)
{
  Random random(11);
  int seen = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const Setting setting = randomSetting(random);
    SCOPED_TRACE(setting.name + ", number " + std::to_string(i));
    const Points body = setting.body().vertices();
    const glm::dmat4 centredFromLight = glm::inverse(setting.rays.viewFromCentred);
    const double size = setting.scene.radius() + glm::length(setting.camera.eyeCentred()) +
      glm::length(glm::dvec3(centredFromLight[3]));
    for (const glm::dvec3& vertex : body)
    {
      // A vertex is itself visible, to within rounding.
      const glm::dvec3 centred(centredFromLight * glm::dvec4(vertex, 1.0));
      const glm::dvec4 clip = setting.camera.clipFromCentred() * glm::dvec4(centred, 1.0);
      double largest = 0.0; // the rounding of clip coordinates is proportional to it
      for (int column = 0; column < 4; ++column)
      {
        const glm::dvec4 entries = glm::abs(setting.camera.clipFromCentred()[column]);
        largest = std::max({ largest, entries.x, entries.y, entries.z, entries.w });
      }
      const double room = 1e-9 * largest * std::max(size, 1.0);
      ASSERT_TRUE(
        glm::all(glm::lessThanEqual(glm::abs(glm::dvec3(clip)), glm::dvec3(clip.w + room))));
      ASSERT_TRUE(glm::all(glm::lessThanEqual(setting.scene.lower - 1e-9 * size, centred)));
      ASSERT_TRUE(glm::all(glm::lessThanEqual(centred, setting.scene.upper + 1e-9 * size)));
      for (const HalfSpace& halfSpace : setting.reach)
      {
        ASSERT_GE(glm::dot(halfSpace, glm::dvec4(vertex, 1.0)), -1e-9 * size);
      }
      if (setting.rays.positional)
      {
        ASSERT_GT(vertex.z, 0.0);
      }
    }
    // No visible point lies beyond all vertices in any direction.
    for (const glm::dvec3& centred : setting.visiblePoints(random, 50))
    {
      ++seen;
      const glm::dvec3 point = inView(setting.rays, centred);
      for (int k = 0; k < 20; ++k)
      {
        const glm::dvec3 direction = unitVector(random);
        double farthest = -std::numeric_limits<double>::infinity();
        for (const glm::dvec3& vertex : body)
        {
          farthest = std::max(farthest, glm::dot(direction, vertex));
        }
        ASSERT_LE(glm::dot(direction, point), farthest + 1e-9 * size);
      }
    }
  }
  EXPECT_GT(seen, 2000);
}

TEST(VisibleBody, IsEmptyWhereThereIsNothingToSee)
{
  const Setting plain = terrain(directionalRays({ 0.0, 0.0, -1.0 }));
  EXPECT_FALSE(plain.body().empty());
  Setting away = plain;
  away.camera =
    perspectiveCamera({ 0.0, -1100.0, 10.0 }, { 0.0, -2000.0, 10.0 }, 40.0, 1.0, 3000.0);
  EXPECT_TRUE(away.body().empty());
  Setting nothing = plain;
  nothing.scene = Bounds();
  EXPECT_TRUE(nothing.body().empty());
  Setting behind = terrain(spotRays({ 0.0, 0.0, 100.0 }, { 0.0, 0.0, 1.0 }));
  EXPECT_EQ(nearestOf(behind.scene, behind.rays), 0.0);
  behind.reach = coneHalfSpaces(1.0, 0.0);
  EXPECT_TRUE(behind.body().empty());
  Setting broken = plain;
  broken.camera.clipFromView = glm::dmat4(std::nan(""));
  EXPECT_TRUE(broken.body().empty());
}

TEST(VisibleBody, OfACubesFacesFillsTheFaces)
{
  Setting setting;
  setting.scene = { glm::dvec3(-5.0), glm::dvec3(5.0) };
  setting.camera = perspectiveCamera({ 30.0, 0.0, 0.0 }, glm::dvec3(0.0), 60.0, 1.0, 100.0);
  for (int face = 0; face < cubeFaces; ++face)
  {
    setting.rays = { glm::dmat4(cubeFaceFromLight(face)), true };
    setting.reach = cubeFaceHalfSpaces(nearestOf(setting.scene, setting.rays));
    const Rectangle range =
      rangeOf(glm::dmat3(1.0), setting.rays.across(setting.body().vertices()));
    EXPECT_LT(glm::length(range.lower + 1.0), 1e-12);
    EXPECT_LT(glm::length(range.upper - 1.0), 1e-12);
  }
}

TEST(VisibleBody, OfAConeLiesLittleBeyondIt)
{
  Setting setting = terrain(spotRays({ 0.0, 0.0, 500.0 }, { 0.0, 0.0, -1.0 }));
  setting.camera = perspectiveCamera({ 0.0, 0.0, 5000.0 }, glm::dvec3(0.0), 60.0, 1.0, 1e4);
  setting.reach = coneHalfSpaces(0.5, nearestOf(setting.scene, setting.rays));
  double farthest = 0.0;
  for (const glm::dvec2& across : setting.rays.across(setting.body().vertices()))
  {
    farthest = std::max(farthest, glm::length(across));
  }
  EXPECT_GE(farthest, 0.5);
  EXPECT_LE(farthest, 0.5 / std::cos(glm::radians(22.5)) + 1e-12);
}

} // namespace
} // namespace gnomon::test
