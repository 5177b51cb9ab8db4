#include "lights/LightSpace.h"

#include "Random.h"

#include "lights/PlanarProjection.h"
#include "lights/SceneFrame.h"
#include "lights/ShadowLight.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace gnomon::test
{
namespace
{

glm::dvec3 apply(const glm::dmat4& matrix, const glm::dvec3& point)
{
  return glm::dvec3(matrix * glm::dvec4(point, 1.0));
}

void expectRigid(const glm::dmat3& matrix)
{
  const glm::dmat3 product = matrix * glm::transpose(matrix);
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(product[i][k], i == k ? 1.0 : 0.0, 1e-14);
    }
  }
  EXPECT_NEAR(glm::determinant(matrix), 1.0, 1e-14);
}

TEST(LightSpace, IsRigidAndLooksAlongTheLight)
{
  const glm::dvec3 centre(10.0, 20.0, 30.0);
  Random random(3);
  std::vector<glm::dvec3> directions = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 },
    { 0, -1, 0 }, { 0, 0, -1 } };
  std::generate_n(std::back_inserter(directions), 100, [&] { return unitVector(random); });
  for (const glm::dvec3& direction : directions)
  {
    ShadowLight light;
    light.directionWorld = direction;
    light.positionWorld = { 11.0, 18.0, 30.5 };
    for (const LightKind kind : { LightKind::Directional, LightKind::Spot })
    {
      light.kind = kind;
      const glm::dmat4 matrix = lightFromCentred(light, centre);
      expectRigid(glm::dmat3(matrix));
      const glm::dvec3 ahead =
        light.positionWorld + 2.0 * light.directionWorld - centre; // two units down the light
      const glm::dvec3 start = light.positionWorld - centre;
      EXPECT_NEAR((apply(matrix, ahead) - apply(matrix, start)).z, 2.0, 1e-13);
      if (kind == LightKind::Spot)
      {
        EXPECT_LT(glm::length(apply(matrix, start)), 1e-13);
      }
    }
  }
}

TEST(LightSpace, OfPointLightsIsTheWorldMoved)
{
  ShadowLight light;
  light.kind = LightKind::Point;
  light.positionWorld = { 3.0, 4.0, 5.0 };
  const glm::dmat4 matrix = lightFromCentred(light, { 1.0, 1.0, 1.0 });
  EXPECT_EQ(apply(matrix, { 2.0, 3.0, 4.5 }), glm::dvec3(0.0, 0.0, 0.5));
}

TEST(LightSpace, OfABoxStandsOnItsUpDirection)
{
  ShadowLight light;
  light.positionWorld = { 1.0, 2.0, 3.0 };
  light.directionWorld = { 1.0, 0.0, 0.0 };
  light.box = LightBox{ 2.0, 4.0, 6.0, { 0.7, 5.0, 0.0 } };
  const glm::dmat4 matrix = lightFromCentred(light, glm::dvec3(0.0));
  expectRigid(glm::dmat3(matrix));
  EXPECT_LT(glm::length(apply(matrix, { 1.0, 2.0, 3.0 })), 1e-14);
  EXPECT_LT(glm::length(apply(matrix, { 1.0, 3.0, 3.0 }) - glm::dvec3(0, 1, 0)), 1e-14);
  EXPECT_LT(glm::length(apply(matrix, { 1.5, 2.0, 3.0 }) - glm::dvec3(0, 0, 0.5)), 1e-14);
  EXPECT_NEAR(std::abs(apply(matrix, { 1.0, 2.0, 4.0 }).x), 1.0, 1e-14);
}

TEST(CubeFaces, BordersBelongToOneFace)
{
  EXPECT_EQ(cubeFaceOf({ 1.0, 1.0, 1.0 }), 0);
  EXPECT_EQ(cubeFaceOf({ -1.0, 1.0, 1.0 }), 1);
  EXPECT_EQ(cubeFaceOf({ 0.5, 1.0, -1.0 }), 2);
  EXPECT_EQ(cubeFaceOf({ 0.5, -1.0, -1.0 }), 3);
  EXPECT_EQ(cubeFaceOf({ 0.5, -0.5, 1.0 }), 4);
  EXPECT_EQ(cubeFaceOf({ 0.5, -0.5, -1.0 }), 5);
  EXPECT_EQ(cubeFaceOf({ 0.0, 0.0, 0.0 }), 0);
}

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

glm::dvec3 project(const glm::dvec4& plane, const glm::dvec4& light, const glm::dvec3& point)
{
  const glm::dvec4 image = planarProjection(plane, light) * glm::dvec4(point, 1.0);
  return glm::dvec3(image) / image.w;
}

/// Return a point's distance from the line through two others, as a share of its distance from the
/// first.
double offLine(const glm::dvec3& from, const glm::dvec3& direction, const glm::dvec3& point)
{
  const glm::dvec3 way = point - from;
  return glm::length(glm::cross(glm::normalize(direction), way)) / glm::length(way);
}

// Survey, rows 1 and 2: any plane, lamps and parallel rays.
TEST(PlanarProjection, liesOnThePlaneAndOnTheRay)
{
  Random random(1);
  int between = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 normal = unitVector(random);
    const glm::dvec4 plane(normal, uniform(random, -5.0, 5.0));
    for (const bool positional : { false, true })
    {
      const glm::dvec4 light =
        positional ? glm::dvec4(inCube(random, 9.0), 1.0) : glm::dvec4(unitVector(random), 0.0);
      const glm::dvec3 v = inCube(random, 9.0);
      const double w = (planarProjection(plane, light) * glm::dvec4(v, 1.0)).w;
      if (std::abs(w) < 0.1)
      {
        continue; // the ray runs along the plane
      }
      const glm::dvec3 p = project(plane, light, v);
      EXPECT_NEAR(glm::dot(plane, glm::dvec4(p, 1.0)), 0.0, 1e-5);
      EXPECT_LT(offLine(v, positional ? glm::dvec3(light) - v : glm::dvec3(light), p), 1e-5);
      // The sign of w gives the order of plane, point and light.
      const double lightHeight = glm::dot(plane, light);
      const double height = glm::dot(plane, glm::dvec4(v, 1.0));
      if (lightHeight > 0.0 && positional)
      {
        EXPECT_EQ(w > 0.0, height < lightHeight);
        between += height > 0.0 && height < lightHeight ? 1 : 0;
      }
      if (!positional)
      {
        EXPECT_NEAR(w, lightHeight, 1e-12);
      }
    }
  }
  EXPECT_GT(between, 50);
}

} // namespace
} // namespace gnomon::test
