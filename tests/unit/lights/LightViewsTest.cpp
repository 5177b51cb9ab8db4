#include "ViewPoints.h"

#include "lights/LightAt.h"
#include "lights/LightSamples.h"
#include "lights/LightSpace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int mapSize = 64;
const glm::dvec3 viewsCentre(100.0, -50.0, 7.0);

ShadowLight lightAround(LightKind kind, const glm::dvec3& positionCentred,
  const glm::dvec3& direction = { 0.0, 0.0, -1.0 }, double coneAngleDegrees = 0.0)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = viewsCentre + positionCentred;
  light.directionWorld = glm::normalize(direction);
  light.coneAngleDegrees = coneAngleDegrees;
  return light;
}

LightViews fit(const ShadowLight& light, const Bounds& casters)
{
  return fitLightViews(light, { viewsCentre, casters, {}, { mapSize, 1 }, {} });
}

/// Expect a point within a view, a texel away from its border and at a depth well below 1.
void expectSeen(const LightView* view, const glm::dvec3& point)
{
  ASSERT_TRUE(view) << point.x << ", " << point.y << ", " << point.z;
  const glm::dvec4 clip = view->clipFromCentred() * glm::dvec4(point, 1.0);
  const double inner = 1.0 - 2.0 / mapSize + 1e-9;
  EXPECT_LE(std::abs(clip.x), inner * clip.w);
  EXPECT_LE(std::abs(clip.y), inner * clip.w);
  EXPECT_LE(std::abs(clip.z), clip.w * (1.0 + 1e-12));
  const double z = (view->rays.viewFromCentred * glm::dvec4(point, 1.0)).z;
  const double depth = view->depthScale * z + view->depthOffset;
  EXPECT_GE(depth, -1e-12);
  EXPECT_LE(depth, 0.95);
}

void expectAllSeen(const ShadowLight& light, const Bounds& casters)
{
  const LightViews views = fit(light, casters);
  for (const glm::dvec3& point : pointsIn(casters))
  {
    expectSeen(viewOf(views, point), point);
  }
}

std::vector<int> facesOf(const LightViews& views)
{
  std::vector<int> faces;
  for (int face = 0; face < cubeFaces; ++face)
  {
    if (views.viewOfFace[static_cast<std::size_t>(face)] != LightViews::noView)
    {
      faces.push_back(face);
    }
  }
  return faces;
}

TEST(LightViews, LayoutFollowsFromTheLightAlone)
{
  EXPECT_EQ(viewLayout(lightAround(LightKind::Directional, {})), ViewLayout::Single);
  EXPECT_EQ(viewLayout(lightAround(LightKind::Spot, {}, { 0, 0, 1 }, 60.0)), ViewLayout::Single);
  EXPECT_EQ(viewLayout(lightAround(LightKind::Spot, {}, { 0, 0, 1 }, 60.1)), ViewLayout::Cube);
  EXPECT_EQ(viewLayout(lightAround(LightKind::Point, {})), ViewLayout::Cube);
}

TEST(LightViews, SeeAllCasters)
{
  const Bounds casters{ { -1.0, -2.0, -0.5 }, { 3.0, 1.0, 2.0 } };
  const Bounds floor{ { -3.0, -3.0, 0.0 }, { 3.0, 3.0, 0.0 } };
  for (const glm::dvec3& direction :
    { glm::dvec3(0, 0, -1), { 0, 1, 0 }, { -1, 0, 0 }, { 0.3, -0.5, -0.7 } })
  {
    expectAllSeen(lightAround(LightKind::Directional, {}, direction), casters);
    expectAllSeen(lightAround(LightKind::Directional, {}, direction), floor);
  }
  expectAllSeen(lightAround(LightKind::Spot, { 1.0, 0.0, 9.0 }, { 0, 0, -1 }, 50.0), casters);
  for (const glm::dvec3& position : { glm::dvec3(1.0, 0.0, 9.0), { 6.0, 7.0, 8.0 },
         { -20.0, 0.1, 0.2 }, { 1e6, 1e6, 0.0 }, { 9.0, 0.2, 0.0 } })
  {
    expectAllSeen(lightAround(LightKind::Point, position), casters);
    expectAllSeen(lightAround(LightKind::Point, position), floor);
  }
}

TEST(LightViews, KeepTheBorderThatTheyAreAskedFor)
{
  const Bounds casters{ { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 } };
  // The border is at most a quarter of the side.
  for (const auto& [asked, kept] : { std::pair(1, 1), { 5, 5 }, { 1000, mapSize / 4 } })
  {
    const auto texelOf = [](const LightView& view, const glm::dvec3& point)
    {
      const glm::dvec4 clip = view.clipFromCentred() * glm::dvec4(point, 1.0);
      return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(mapSize);
    };
    // A cube face has its border at 45 degrees, a sun's view around the casters.
    const LightViews faces = fitLightViews(
      lightAround(LightKind::Point, {}), { viewsCentre, casters, {}, { mapSize, asked }, {} });
    ASSERT_EQ(faces.views.size(), 6u);
    const LightViews suns = fitLightViews(lightAround(LightKind::Directional, {}, { 0, 0, -1 }),
      { viewsCentre, casters, {}, { mapSize, asked }, {} });
    for (const LightView* view : { &faces.views[5], &suns.views[0] })
    {
      const glm::dvec2 corner = texelOf(*view, { 1.0, 1.0, -1.0 });
      const glm::dvec2 fromBorder = glm::min(corner, static_cast<double>(mapSize) - corner);
      EXPECT_NEAR(fromBorder.x, kept, 1e-3) << asked;
      EXPECT_NEAR(fromBorder.y, kept, 1e-3) << asked;
    }
  }
}

/// Return the lower and upper slopes that a view's map spans, in the view's own space.
std::pair<glm::dvec2, glm::dvec2> slopesOf(const LightView& view)
{
  const glm::dvec2 scale(view.mapFromAcross[0].x, view.mapFromAcross[1].y);
  const glm::dvec2 offset(view.mapFromAcross[2]);
  return { (-1.0 - offset) / scale, (1.0 - offset) / scale };
}

TEST(LightViews, FacesSeeCastersThatLieWithinTheBorderBeyondTheirEdge)
{
  // A plate below the light, up to 0.995 of the slope at which the face +x begins.
  const Bounds plate{ { 1.0, -1.0, -2.0 }, { 1.99, 1.0, -2.0 } };
  constexpr int border = 8;
  const LightViews wide = fitLightViews(
    lightAround(LightKind::Point, {}), { viewsCentre, plate, {}, { mapSize, border }, {} });
  EXPECT_EQ(facesOf(wide), std::vector<int>({ 0, 5 }));
  // The map spans from the plate beyond the edge to the last point on this side that reads it.
  const auto [lower, upper] = slopesOf(wide.views.at(0));
  const glm::dvec2 texel = (upper - lower) / static_cast<double>(mapSize);
  const LightView& face = wide.views.at(0);
  const glm::dvec4 down = face.rays.viewFromCentred * glm::dvec4(0.0, 0.0, -1.0, 0.0);
  const int axis = std::abs(down.x) > 0.5 ? 0 : 1; // of the edge near the plate
  const double edge = down[axis];
  EXPECT_GE((edge < 0.0 ? -lower[axis] : upper[axis]), 1.0 + (border - 1e-3) * texel[axis]);
  EXPECT_LE((edge < 0.0 ? lower[axis] : -upper[axis]), -1.0 + border * texel[axis]);
  // A plate out of reach leaves the face out.
  EXPECT_EQ(facesOf(fit(lightAround(LightKind::Point, {}),
              Bounds{ { 1.0, -1.0, -2.0 }, { 1.8, 1.0, -2.0 } })),
    std::vector<int>({ 5 }));
}

TEST(LightViews, FacesThatShareAnEdgeWithCastersHaveTexelsOfASize)
{
  // The face below sees the whole floor, the faces beside it a sliver.
  const Bounds floor{ { -2.02, -2.02, -2.0 }, { 2.02, 2.02, -2.0 } };
  const LightViews views = fit(lightAround(LightKind::Point, {}), floor);
  EXPECT_EQ(facesOf(views), std::vector<int>({ 0, 1, 2, 3, 5 }));
  double smallest = 1e300;
  double largest = 0.0;
  for (const LightView& view : views.views)
  {
    const auto [lower, upper] = slopesOf(view);
    smallest = std::min({ smallest, upper.x - lower.x, upper.y - lower.y });
    largest = std::max({ largest, upper.x - lower.x, upper.y - lower.y });
  }
  EXPECT_LE(largest, 2.001 * smallest);
}

TEST(LightViews, WideSpotsDoNotLookBehindThemselves)
{
  const Bounds room{ glm::dvec3(-3.0), glm::dvec3(3.0) };
  const LightViews views = fit(lightAround(LightKind::Spot, {}, { 0.0, 0.0, -1.0 }, 75.0), room);
  EXPECT_EQ(facesOf(views), std::vector<int>({ 0, 1, 2, 3, 4 }));
  EXPECT_NEAR(views.coneTangentSquared, std::pow(std::tan(glm::radians(75.0)), 2.0), 1e-12);
  for (const glm::dvec3& point : pointsIn(Bounds{ glm::dvec3(-3.0), { 3.0, 3.0, 0.0 } }))
  {
    if (glm::length(point) > 0.01)
    {
      expectSeen(viewOf(views, point), point);
    }
  }
}

TEST(LightViews, AreEmptyWithoutCasters)
{
  EXPECT_TRUE(fit(lightAround(LightKind::Directional, {}), Bounds()).views.empty());
  EXPECT_TRUE(fit(lightAround(LightKind::Point, {}), Bounds()).views.empty());
  const Bounds behind{ { -1.0, -1.0, 1.0 }, { 1.0, 1.0, 2.0 } };
  for (const double cone : { 20.0, 60.0, 89.0 })
  {
    EXPECT_TRUE(fit(lightAround(LightKind::Spot, {}, { 0, 0, -1 }, cone), behind).views.empty());
  }
  const Bounds aside{ { 5.0, -1.0, -2.0 }, { 6.0, 1.0, -1.0 } };
  EXPECT_TRUE(fit(lightAround(LightKind::Spot, {}, { 0, 0, -1 }, 30.0), aside).views.empty());
}

TEST(LightViews, OfABoxHoldWhatIsInIt)
{
  ShadowLight light = lightAround(LightKind::Directional, { 0.0, 0.0, 5.0 });
  light.box = LightBox{ 2.0, 4.0, 4.0 };
  // Casters lie across the near face at z = 5, past the far one at z = 1, and over the sides.
  const LightViews views = fit(light, Bounds{ { -9.0, -0.5, 0.0 }, { 9.0, 9.0, 8.0 } });
  ASSERT_EQ(views.views.size(), 1u);
  EXPECT_EQ(views.views[0].beginsAt, 0.0);
  EXPECT_EQ(views.box, glm::dvec3(1.0, 2.0, 4.0));
  for (const glm::dvec3& point : pointsIn(Bounds{ { -1.0, -0.5, 1.0 }, { 1.0, 2.0, 5.0 } }))
  {
    expectSeen(&views.views[0], point);
  }
  EXPECT_LT(fit(light, Bounds{ { -9.0, -0.5, 0.0 }, { 9.0, 9.0, 4.9 } }).views[0].beginsAt, 0.0);
  EXPECT_TRUE(fit(light, Bounds{ { -9.0, -0.5, 5.1 }, { 9.0, 9.0, 8.0 } }).views.empty());
  EXPECT_TRUE(fit(light, Bounds{ { 1.1, -0.5, 0.0 }, { 9.0, 9.0, 8.0 } }).views.empty());
}

TEST(LightView, LeavesOutOnlyWhatItCannotSee)
{
  const Bounds room{ glm::dvec3(-3.0), glm::dvec3(3.0) };
  const LightViews views = fit(lightAround(LightKind::Point, glm::dvec3(0.0)), room);
  const auto seenBy = [&](const Bounds& part)
  {
    return std::count_if(views.views.begin(), views.views.end(),
      [&](const LightView& view) { return view.maySee(part); });
  };
  EXPECT_EQ(seenBy(Bounds{ { 2.0, -0.5, -0.5 }, { 2.5, 0.5, 0.5 } }), 1);
  EXPECT_EQ(seenBy(Bounds{ { 2.0, 1.5, -0.5 }, { 2.5, 2.5, 0.5 } }), 2);
  EXPECT_EQ(seenBy(Bounds{ { 2.0, 2.0, 2.0 }, { 2.5, 2.5, 2.5 } }), 3);
  EXPECT_EQ(seenBy(room), 6);
  EXPECT_EQ(seenBy(Bounds()), 0);
  // A view that sees a point of a box may see the box.
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    Bounds part;
    part.add(inCube(random, 3.0));
    part.add(part.lower + inCube(random, 1.5));
    for (const glm::dvec3& corner : part.corners())
    {
      EXPECT_TRUE(viewOf(views, corner)->maySee(part));
    }
  }
}

const Bounds scene{ { -3.0, -2.0, 0.0 }, { 3.0, 4.0, 2.5 } };
const ViewFitting fittingToScene{ viewsCentre, scene, scene, { mapSize, 1 }, {} };

/// True if a light's views see a point, as shaders find it.
bool isSeen(const LightViews& views, const glm::dvec3& centred)
{
  const LightView* const view = viewOf(views, centred);
  const glm::dvec4 clip =
    view ? view->clipFromCentred() * glm::dvec4(centred, 1.0) : glm::dvec4(0.0);
  const double z = view ? (view->rays.viewFromCentred * glm::dvec4(centred, 1.0)).z : 0.0;
  const double most = clip.w * (1.0 + 1e-12);
  return z > 0.0 && std::abs(clip.x) <= most && std::abs(clip.y) <= most &&
    z * view->depthScale + view->depthOffset < 0.95;
}

bool isInCone(const ShadowLight& light, const glm::dvec3& centred)
{
  const glm::dvec3 p(lightFromCentred(light, viewsCentre) * glm::dvec4(centred, 1.0));
  const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
  return p.z > 0.0 && std::hypot(p.x, p.y) <= tangent * p.z;
}

/// Each point of a spot light sees all points that its centre lights: from outside the scene, from
/// its edge and from inside.
TEST(LightAt, seesFromAllPointsWhatTheCentreOfASpotReaches)
{
  for (const glm::dvec3& place :
    { glm::dvec3(0.5, 0.5, 9.0), { 2.0, 5.0, 4.0 }, { 0.0, 0.0, 2.5 }, { 0.3, 0.2, 1.0 } })
  {
    for (const double angle : { 20.0, 40.0, 75.0 })
    {
      ShadowLight light = lightAround(LightKind::Spot, place, { 0.1, -0.3, -1.0 }, angle);
      light.lightSamples = 12;
      light.area = rectangleArea(light.directionWorld, { 0.3, 1.0, 0.2 }, { 0.5, 0.3 });
      std::size_t lit = 0;
      for (const glm::dvec3& offset : pairedLightSamples(light))
      {
        const ShadowLight at = lightAt(light, offset, fittingToScene);
        EXPECT_EQ(at.positionWorld, light.positionWorld + offset);
        EXPECT_EQ(at.directionWorld, light.directionWorld);
        EXPECT_FALSE(at.area);
        const LightViews views = fitLightViews(at, fittingToScene);
        for (const glm::dvec3& point : pointsIn(scene))
        {
          if (isInCone(light, point))
          {
            ++lit;
            EXPECT_TRUE(isSeen(views, point)) << place.z << " " << angle;
          }
        }
      }
      EXPECT_GT(lit, 0u) << place.z << " " << angle;
    }
  }
}

/// A light point's box holds every ray from the centre's box to that point, as far as the centre's
/// near face.
TEST(LightAt, standsABoxAroundAllRaysIntoTheCentresBox)
{
  for (const glm::dvec3& up : { glm::dvec3(0.0, 1.0, 0.0), { 1.0, 0.2, 0.0 } })
  {
    ShadowLight light = lightAround(LightKind::Directional, { 0.5, 0.2, 3.0 }, { 0.2, 0.5, -1.0 });
    light.lightSamples = 12;
    light.box = LightBox{ 2.0, 1.5, 4.0, up };
    // Sizes of lights, up to 80 degrees.
    for (const double size : { 0.01, 0.3, 1.7 })
    {
      light.area = rectangleArea(light.directionWorld, { 0.3, 1.0, 0.2 }, { size, 0.7 * size });
      for (const glm::dvec3& offset : pairedLightSamples(light))
      {
        const ShadowLight at = lightAt(light, offset, fittingToScene);
        ASSERT_TRUE(at.box);
        const glm::dvec3 travel = glm::normalize(light.directionWorld - offset);
        EXPECT_LT(glm::distance(at.directionWorld, travel), 1e-15);
        const glm::dmat4 boxFromCentred = lightFromCentred(at, viewsCentre);
        const glm::dmat4 centredFromLight = glm::inverse(lightFromCentred(light, viewsCentre));
        const Bounds whole{ { -1.0, -0.75, 0.0 }, { 1.0, 0.75, 4.0 } };
        for (const glm::dvec3& point : pointsIn(whole))
        {
          const glm::dvec3 centred(centredFromLight * glm::dvec4(point, 1.0));
          for (const double share : { 0.0, 0.4, 1.0 })
          {
            const glm::dvec3 onRay = centred + share * point.z * (offset - light.directionWorld);
            const glm::dvec3 inBox(boxFromCentred * glm::dvec4(onRay, 1.0));
            EXPECT_LE(std::abs(inBox.x), 0.5 * at.box->width + 1e-9);
            EXPECT_LE(std::abs(inBox.y), 0.5 * at.box->height + 1e-9);
            EXPECT_GE(inBox.z, -1e-9);
            EXPECT_LE(inBox.z, at.box->depth + 1e-9);
          }
        }
      }
    }
  }
}

} // namespace
} // namespace gnomon::test
