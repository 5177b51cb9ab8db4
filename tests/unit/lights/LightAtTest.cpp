#include "lights/LightAt.h"

#include "ViewPoints.h"

#include "lights/LightSamples.h"
#include "lights/LightSpace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gnomon::test
{
namespace
{

const glm::dvec3 placesCentre(100.0, -50.0, 7.0);
const Bounds scene{ { -3.0, -2.0, 0.0 }, { 3.0, 4.0, 2.5 } };

ViewFitting fittingTo(const Bounds& bounds)
{
  return { placesCentre, bounds, bounds, { 64, 1 }, {} };
}

ShadowLight lightTowards(
  LightKind kind, const glm::dvec3& positionCentred, const glm::dvec3& direction)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = placesCentre + positionCentred;
  light.directionWorld = glm::normalize(direction);
  light.coneAngleDegrees = 40.0;
  light.lightSamples = 12;
  light.area = rectangleArea(light.directionWorld, { 0.3, 1.0, 0.2 }, { 0.5, 0.3 });
  return light;
}

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
  const glm::dvec3 p(lightFromCentred(light, placesCentre) * glm::dvec4(centred, 1.0));
  const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
  return p.z > 0.0 && std::hypot(p.x, p.y) <= tangent * p.z;
}

/// Each point of a spot light sees all points that its centre lights: from outside the scene, from
/// its edge and from inside.
TEST(LightAt, seesFromAllPointsWhatTheCentreOfASpotReaches)
{
  const ViewFitting fitting = fittingTo(scene);
  for (const glm::dvec3& place :
    { glm::dvec3(0.5, 0.5, 9.0), { 2.0, 5.0, 4.0 }, { 0.0, 0.0, 2.5 }, { 0.3, 0.2, 1.0 } })
  {
    for (const double angle : { 20.0, 40.0, 75.0 })
    {
      ShadowLight light = lightTowards(LightKind::Spot, place, { 0.1, -0.3, -1.0 });
      light.coneAngleDegrees = angle;
      std::size_t lit = 0;
      for (const glm::dvec3& offset : pairedLightSamples(light))
      {
        const ShadowLight at = lightAt(light, offset, fitting);
        EXPECT_EQ(at.positionWorld, light.positionWorld + offset);
        EXPECT_EQ(at.directionWorld, light.directionWorld);
        EXPECT_FALSE(at.area);
        const LightViews views = fitLightViews(at, fitting);
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

TEST(LightAt, laysOutAllPointsOfALightAlike)
{
  const auto layouts = [](const ShadowLight& light)
  {
    std::vector<ViewLayout> ofPoints;
    for (const glm::dvec3& offset : pairedLightSamples(light))
    {
      ofPoints.push_back(viewLayout(lightAt(light, offset, fittingTo(scene))));
    }
    return ofPoints;
  };
  const std::vector<ViewLayout> single(12, ViewLayout::Single);
  const std::vector<ViewLayout> cube(12, ViewLayout::Cube);
  const glm::dvec3 down(0.0, 0.0, -1.0);
  EXPECT_EQ(layouts(lightTowards(LightKind::Spot, { 0.0, 0.0, 9.0 }, down)), single);
  EXPECT_EQ(layouts(lightTowards(LightKind::Spot, { 0.0, 0.0, 2.0 }, down)), cube)
    << "receivers may be at the lamp";
  EXPECT_EQ(layouts(lightTowards(LightKind::Point, { 0.0, 0.0, 9.0 }, down)), cube);
  EXPECT_EQ(layouts(lightTowards(LightKind::Directional, {}, down)), single);
}

/// A light point's box holds every ray from the centre's box to that point, as far as the centre's
/// near face.
TEST(LightAt, standsABoxAroundAllRaysIntoTheCentresBox)
{
  for (const glm::dvec3& up : { glm::dvec3(0.0, 1.0, 0.0), { 1.0, 0.2, 0.0 } })
  {
    ShadowLight light = lightTowards(LightKind::Directional, { 0.5, 0.2, 3.0 }, { 0.2, 0.5, -1.0 });
    light.box = LightBox{ 2.0, 1.5, 4.0, up };
    // Sizes of lights, up to 80 degrees.
    for (const double size : { 0.01, 0.3, 1.7 })
    {
      light.area = rectangleArea(light.directionWorld, { 0.3, 1.0, 0.2 }, { size, 0.7 * size });
      for (const glm::dvec3& offset : pairedLightSamples(light))
      {
        const ShadowLight at = lightAt(light, offset, fittingTo(scene));
        ASSERT_TRUE(at.box);
        const glm::dvec3 travel = glm::normalize(light.directionWorld - offset);
        EXPECT_LT(glm::distance(at.directionWorld, travel), 1e-15);
        const glm::dmat4 boxFromCentred = lightFromCentred(at, placesCentre);
        const glm::dmat4 centredFromLight = glm::inverse(lightFromCentred(light, placesCentre));
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
