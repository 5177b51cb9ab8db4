#include "lights/SceneFrame.h"

#include "lights/ShadowLight.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace gnomon;

namespace
{

ShadowLight lampAt(const glm::dvec3& positionWorld, LightKind kind)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = positionWorld;
  light.coneAngleDegrees = kind == LightKind::Spot ? 30.0 : 0.0;
  return light;
}

/// A frame whose unit is 2^60 long, around a scene at a place off the origin.
const SceneFrame largeFrame{ { 64.0, 0.0, -128.0 }, 60 };

} // namespace

TEST(SceneFrame, takesPlacesAndMatricesToCentredCoordinatesAndBack)
{
  const glm::dvec3 place = largeFrame.unitWorld() * glm::dvec3(65.0, 0.25, -127.0);
  EXPECT_EQ(largeFrame.fromWorld(place), glm::dvec3(1.0, 0.25, 1.0));
  EXPECT_EQ(largeFrame.toWorld({ 1.0, 0.25, 1.0 }), place);
  glm::dmat4 projective = glm::translate(glm::dmat4(1.0), place);
  projective[0].w = std::ldexp(1.0, -62);
  const glm::dvec4 point(std::ldexp(1.0, 61), 0.0, 0.0, 1.0);
  const glm::dvec4 world = projective * point;
  const glm::dvec4 centred = largeFrame.centredFrom(projective) * point;
  const glm::dvec3 expected = largeFrame.fromWorld(glm::dvec3(world) / world.w);
  EXPECT_LT(glm::distance(glm::dvec3(centred) / centred.w, expected), 1e-12);
}

TEST(SceneFrame, countsALightsLengthsInItsUnits)
{
  const double unit = largeFrame.unitWorld();
  ShadowLight lamp = lampAt(unit * glm::dvec3(1.0, 2.0, 3.0), LightKind::Spot);
  lamp.area = diskArea(lamp.directionWorld, 0.5 * unit);
  EXPECT_EQ(enterFrame(lamp, largeFrame), "");
  EXPECT_EQ(lamp.positionWorld, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(lamp.area->radius(), 0.5);
  EXPECT_EQ(lamp.unitWorld, unit);

  ShadowLight sun;
  sun.area = diskArea(sun.directionWorld, 0.01);
  sun.box = LightBox{ 2.0 * unit, 3.0 * unit, 1e60 };
  EXPECT_EQ(enterFrame(sun, largeFrame), "");
  EXPECT_EQ(sun.area->radius(), 0.01) << "an angle";
  EXPECT_EQ(sun.box->width, 2.0);
  EXPECT_EQ(sun.box->height, 3.0);
  EXPECT_EQ(sun.box->depth, 1e18) << "its square is a float";
}

TEST(SceneFrame, makesFarLampsParallel)
{
  for (const double far : { 1e19, 1e100, 1e300 })
  {
    for (const LightKind kind : { LightKind::Spot, LightKind::Point })
    {
      ShadowLight lamp = lampAt({ 0.6 * far, 0.0, 0.8 * far }, kind);
      lamp.directionWorld = glm::normalize(glm::dvec3(-0.7, 0.0, -0.8));
      const double radius = 0.01 * far;
      lamp.area =
        kind == LightKind::Spot ? diskArea(lamp.directionWorld, radius) : ballArea(radius);
      EXPECT_EQ(enterFrame(lamp, SceneFrame()), "");
      EXPECT_EQ(lamp.kind, LightKind::Directional);
      EXPECT_LT(glm::distance(lamp.directionWorld, glm::dvec3(-0.6, 0.0, -0.8)), 1e-12);
      EXPECT_EQ(lamp.coneAngleDegrees, 0.0);
      EXPECT_NEAR(lamp.area->radius(), 0.01, 1e-12) << "the angle that it fills";
      EXPECT_NE(lamp.area->shape, LightArea::Shape::Ball);
    }
  }
  ShadowLight small = lampAt({ 1e20, 0.0, 0.0 }, LightKind::Point);
  small.area = ballArea(1.0);
  EXPECT_EQ(enterFrame(small, SceneFrame()), "");
  EXPECT_FALSE(small.area);

  ShadowLight near = lampAt({ 1e17, 0.0, 0.0 }, LightKind::Point);
  EXPECT_EQ(enterFrame(near, SceneFrame()), "");
  EXPECT_EQ(near.kind, LightKind::Point);
}

TEST(SceneFrame, saysWhyALightCannotShine)
{
  ShadowLight away = lampAt({ 0.0, 0.0, 1e20 }, LightKind::Spot);
  away.directionWorld = { 0.0, 0.0, 1.0 };
  EXPECT_EQ(enterFrame(away, SceneFrame()), "it is far away, and its cone passes the scene by");
  ShadowLight box;
  box.positionWorld.z = 1e20;
  EXPECT_EQ(enterFrame(box, SceneFrame()), "") << "a sun is nowhere";
  box.box = LightBox{ 1.0, 1.0, 1.0 };
  EXPECT_EQ(enterFrame(box, SceneFrame()), "its box begins too far away");
  ShadowLight huge = lampAt({ 0.0, 0.0, 1.0 }, LightKind::Point);
  huge.area = ballArea(1e13);
  EXPECT_EQ(enterFrame(huge, SceneFrame()), "its area is too large");
  ShadowLight fits = lampAt({ 0.0, 0.0, 1.0 }, LightKind::Point);
  fits.area = ballArea(1e13);
  EXPECT_EQ(enterFrame(fits, largeFrame), "");
}
