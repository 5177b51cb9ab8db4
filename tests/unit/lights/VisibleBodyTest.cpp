#include "FittedViews.h"

#include <limits>

namespace gnomon::test
{
namespace
{

Bounds boundsOf(const Points& points)
{
  Bounds result;
  for (const glm::dvec3& point : points)
  {
    result.add(point);
  }
  return result;
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

TEST(VisibleBody, SlicedAtDistancesIsAllOfItInParts)
{
  const Setting setting = terrain(directionalRays({ 0.3, 0.2, -1.0 }));
  const ConvexBody body = setting.body();
  const DistanceRange all = distancesOf(body.vertices(), setting.camera, setting.rays);
  EXPECT_NEAR(all.lower, 1.0, 1e-9);
  const double middle = 0.3 * all.lower + 0.7 * all.upper;
  Bounds together;
  for (const auto& [from, to] : { std::pair(all.lower, middle), std::pair(middle, all.upper) })
  {
    const Points slice = sliced(body, setting.camera, setting.rays, from, to).vertices();
    const DistanceRange range = distancesOf(slice, setting.camera, setting.rays);
    EXPECT_NEAR(range.lower, from, 1e-9);
    EXPECT_NEAR(range.upper, to, 1e-9);
    together.add(boundsOf(slice));
  }
  EXPECT_LT(glm::length(together.lower - boundsOf(body.vertices()).lower), 1e-9);
  EXPECT_LT(glm::length(together.upper - boundsOf(body.vertices()).upper), 1e-9);
  EXPECT_TRUE(sliced(body, setting.camera, setting.rays, 1e4, 2e4).empty());
}

} // namespace
} // namespace gnomon::test
