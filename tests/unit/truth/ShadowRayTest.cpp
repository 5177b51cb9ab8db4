#include "shadowtech/base/ShadowRay.h"

#include "EstimatorGlsl.h"
#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/planar/ReceiverPlanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::test
{
namespace
{

/// The arguments of planeNoise() for a triangle.
struct TriangleNumbers
{
  glm::vec3 normal;
  glm::vec3 largest;
  glm::vec3 extent;
  float doubleArea;

  float noise() const
  {
    return planeNoise(this->normal, this->largest, this->extent, this->doubleArea);
  }
};
TriangleNumbers numbersOf(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
  const glm::dvec3 areaVector =
    glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return { glm::vec3(glm::normalize(areaVector)),
    glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))),
    glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c)),
    static_cast<float>(glm::length(areaVector)) };
}

/// Return a number in [-1, 1].
float number(Random& random)
{
  return static_cast<float>(uniform(random, -1.0, 1.0));
}

TEST(PlaneNoise, ScalesWithTheScene)
{
  Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    const glm::vec3 a(inCube(random)), b(inCube(random)), c(inCube(random));
    const float noise = numbersOf(a, b, c).noise();
    for (const float scale : { 1e-10f, 1e-4f, 1e4f, 1e10f })
    {
      EXPECT_NEAR(numbersOf(scale * a, scale * b, scale * c).noise() / scale, noise, 1e-4f * noise);
    }
  }
}

TEST(PlaneNoise, IsZeroWhereFloatsAreExact)
{
  EXPECT_EQ(numbersOf({ -2, -2, 0 }, { 2, -2, 0 }, { 2, 2, 0 }).noise(), 0.0f);
  EXPECT_GT(numbersOf({ -2, -2, 1 }, { 2, -2, 1 }, { 2, 2, 1 }).noise(), 0.0f);
}

/// Shadow rays start close to a triangle, however thin it is.
TEST(PlaneNoise, OfSliversStaysSmall)
{
  for (const float width : { 1e-2f, 1e-4f, 1e-8f, 1e-20f })
  {
    const TriangleNumbers sliver = { glm::normalize(glm::vec3(1.0f, 1.0f, -2.0f)), glm::vec3(1.0f),
      glm::vec3(1.0f), width };
    EXPECT_LT(sliver.noise(), 2e-3f);
    EXPECT_GT(sliver.noise(), 1e-4f);
  }
}

/// Test the sign of Embree's depth, in float, at points that rounding moved off their plane. It is
/// right if the origin is at least planeNoise() off the plane.
TEST(PlaneNoise, BoundsWhatRoundingDoes)
{
  Random random(5);
  for (int i = 0; i < 300000; ++i)
  {
    const float thinness = std::pow(10.0f, 1.3f * number(random) - 1.3f);
    const float size = std::pow(10.0f, 2.0f * number(random));
    const glm::vec3 a = glm::vec3(inCube(random));
    const glm::vec3 b = a + size * glm::vec3(inCube(random));
    const glm::vec3 c = 0.5f * (a + b) + thinness * size * glm::vec3(inCube(random));
    const TriangleNumbers numbers = numbersOf(a, b, c);
    const double u = 0.5 + 0.5 * uniform(random, -1.0, 1.0);
    const double v = (0.5 + 0.5 * uniform(random, -1.0, 1.0)) * (1.0 - u);
    const glm::vec3 stored((1.0 - u - v) * glm::dvec3(a) + u * glm::dvec3(b) + v * glm::dvec3(c));
    const float noise = numbers.noise();
    const glm::vec3 origin = stored + noise * numbers.normal;

    const glm::vec3 v0 = a - origin;
    const glm::vec3 v1 = b - origin;
    const glm::vec3 v2 = c - origin;
    const float depth = glm::dot(v0, glm::cross(v2 - v0, v0 - v1));
    // Below the plane's front: the origin is seen on its intended side.
    ASSERT_LT(depth, 0.0f) << i;
  }
}

TEST(ShadowRay, FacingIsAMatterOfMoreThanRounding)
{
  const glm::vec3 normal(0.0f, 0.0f, 1.0f);
  for (const float length : { 1e-6f, 1.0f, 1e6f })
  {
    EXPECT_TRUE(facesLight(normal, length * glm::vec3(1.0f, 0.0f, 2e-6f)));
    EXPECT_FALSE(facesLight(normal, length * glm::vec3(1.0f, 0.0f, 5e-7f)));
    EXPECT_FALSE(facesLight(normal, length * glm::vec3(1.0f, 0.0f, 0.0f)));
    EXPECT_FALSE(facesLight(normal, length * glm::vec3(1.0f, 0.0f, -1.0f)));
  }
  EXPECT_FALSE(facesLight(normal, glm::vec3(0.0f))) << "at the light itself";
}

TEST(ShadowRay, ConesAreSharpAtAnyAngle)
{
  const glm::vec3 axis(0.0f, 0.0f, 1.0f);
  for (const double degrees : { 0.001, 1.0, 45.0, 89.0 })
  {
    const double angle = glm::radians(degrees);
    const double tangent = std::tan(angle);
    const auto at = [&](double factor)
    { return glm::vec3(std::sin(factor * angle), 0.0, std::cos(factor * angle)); };
    const auto squared = static_cast<float>(tangent * tangent);
    EXPECT_TRUE(insideCone(at(0.0), axis, squared));
    EXPECT_TRUE(insideCone(at(0.99999), axis, squared)) << degrees;
    EXPECT_FALSE(insideCone(at(1.00001), axis, squared)) << degrees;
    EXPECT_FALSE(insideCone(-at(0.0), axis, squared));
  }
}

using ShadowRayGlsl = GlslTest;

TEST_F(ShadowRayGlsl, AgreesWithItsTwin)
{
  Random random(5);
  std::vector<TriangleNumbers> triangles;
  std::vector<glm::mat4> inputs; // normal, noise, footprint and the way to the light
  for (int i = 0; i < 6400; ++i)
  {
    const float size = std::pow(10.0f, 4.0f * number(random));
    triangles.push_back(numbersOf(size * glm::vec3(inCube(random)),
      size * glm::vec3(inCube(random)), size * glm::vec3(inCube(random))));
    const TriangleNumbers& numbers = triangles.back();
    const float footprint = 1e-3f * size;
    const float tangentSquared = 1.0f + number(random);
    inputs.emplace_back(glm::vec4(numbers.normal, 0.0f), glm::vec4(numbers.noise()),
      glm::vec4(footprint), glm::vec4(glm::vec3(inCube(random)), tangentSquared));
  }
  ShaderLibrary library;
  const std::vector<glm::vec4> outputs = runCompute<glm::vec4>(library,
    computeGlsl(ShaderLibrary::source("shadowtech/base/shadow_ray.glsl"), "mat4", "vec4", R"(
  vec4 normal = given[i][0];
  vec4 toLight = given[i][3];
  result[i] = vec4(shadowRayOffset(given[i][1].x, given[i][2].x),
    facesLight(normal.xyz, toLight.xyz) ? 1.0 : 0.0,
    insideCone(toLight.xyz, normal.xyz, toLight.w) ? 1.0 : 0.0, 0.0);
)"),
    inputs);
  const auto ulps = [](float value, float expected)
  {
    return std::abs(value - expected) /
      (std::nextafter(std::abs(expected), std::numeric_limits<float>::infinity()) -
        std::abs(expected));
  };
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const float noise = triangles[i].noise();
    const glm::vec3 normal(inputs[i][0]);
    const glm::vec3 toLight(inputs[i][3]);
    EXPECT_LE(ulps(outputs[i].x, shadowRayOffset(noise, inputs[i][2].x)), 1.0f);
    EXPECT_EQ(outputs[i].y != 0.0f, facesLight(normal, toLight));
    EXPECT_EQ(outputs[i].z != 0.0f, insideCone(toLight, normal, inputs[i][3].w));
  }
}

/// Return a parallelogram of cells x cells x 2 triangles.
Prop patch(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int cells = 1)
{
  Prop prop{ makePlane(1.0, cells) };
  prop.worldFromMesh[0] = glm::dvec4(u, 0.0);
  prop.worldFromMesh[1] = glm::dvec4(v, 0.0);
  prop.worldFromMesh[3] = glm::dvec4(origin + 0.5 * (u + v), 1.0);
  return prop;
}

/// Return a snapshot around the world's origin, so floats are those of the world.
Occluders snapshotOf(const std::vector<Prop>& props)
{
  return makeOccluders(props, glm::dvec3(0.0));
}

ReceiverPlanes planesOf(const Occluders& occluders)
{
  ReceiverPlanes planes;
  planes.update(occluders, mostPlanes);
  return planes;
}

const glm::dvec3 x(1.0, 0.0, 0.0);
const glm::dvec3 y(0.0, 1.0, 0.0);
const glm::dvec3 z(0.0, 0.0, 1.0);

TEST(ReceiverPlanes, ofNothingAreNone)
{
  Occluders occluders;
  occluders.topologyVersion = 1;
  const ReceiverPlanes planes = planesOf(occluders);
  EXPECT_TRUE(planes.planes().empty());
  EXPECT_EQ(planes.area(), 0.0);
}

TEST(ReceiverPlanes, joinWhatIsCoplanarAcrossSurfacesInOrderOfArea)
{
  // The areas are 1, 3 (its front down), 1 and 2; the second and third lie in z = 0.
  std::vector<Prop> props{ patch(-z, x, y), patch(2.0 * x, 3.0 * y, x), patch(-5.0 * x, x, y),
    patch(glm::dvec3(0.0), 2.0 * z, x), patch(z, x, y) };
  props.back().receives = false;
  const ReceiverPlanes planes = planesOf(snapshotOf(props));
  ASSERT_EQ(planes.planes().size(), 3u);
  EXPECT_NEAR(planes.area(), 7.0, 1e-6);
  const double areas[3] = { 4.0, 2.0, 1.0 };
  const glm::dvec3 normals[3] = { z, y, z };
  const double offsets[3] = { 0.0, 0.0, 1.0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const ReceiverPlane& plane = planes.planes()[i];
    EXPECT_NEAR(plane.area, areas[i], 1e-6);
    EXPECT_NEAR(std::abs(glm::dot(glm::dvec3(plane.plane), normals[i])), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(plane.plane.w), offsets[i], 1e-12);
    EXPECT_LT(plane.thickness, 1e-5);
    EXPECT_GT(plane.thickness, 1e-8) << "also through the centre";
  }
  EXPECT_EQ(planes.planes()[0].boundsCentred.lower, glm::dvec3(-5.0, 0.0, 0.0));
  EXPECT_EQ(planes.planes()[0].boundsCentred.upper, glm::dvec3(3.0, 3.0, 0.0));
  EXPECT_EQ(planes.planeOfTriangle(), (std::vector<std::uint8_t>{ 3, 3, 1, 1, 1, 1, 2, 2, 0, 0 }));
}

TEST(ReceiverPlanes, keepParallelSheetsApartThatFloatsCanTellApart)
{
  for (const double size : { 1e-3, 1.0, 1e6 })
  {
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.2, -0.4, 1.0));
    const glm::dvec3 u = 4.0 * size * glm::normalize(glm::cross(up, x));
    const glm::dvec3 v = glm::cross(up, u);
    const ReceiverPlanes planes = planesOf(snapshotOf(
      { patch(-0.5 * (u + v), u, v), patch(-0.4 * (u + v) + 1e-5 * size * up, 0.8 * u, 0.8 * v) }));
    ASSERT_EQ(planes.planes().size(), 2u) << size;
    EXPECT_LT(planes.planes()[0].thickness, 1e-5 * size);
  }
}

TEST(ReceiverPlanes, findFinelyCutOnesWhole)
{
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.2, -0.4, 1.0));
  const glm::dvec3 u = 40.0 * glm::normalize(glm::cross(up, x));
  const glm::dvec3 v = glm::cross(up, u);
  const glm::dvec3 corner(-30.0, 10.0, 5.0);
  const ReceiverPlanes planes =
    planesOf(snapshotOf({ patch(corner, u, v, 300), patch(corner, u, 20.0 * up, 300) }));
  ASSERT_EQ(planes.planes().size(), 2u);
  EXPECT_NEAR(planes.planes()[0].area, 1600.0, 0.01);
  EXPECT_NEAR(planes.planes()[1].area, 800.0, 0.01);
  EXPECT_EQ(std::count(planes.planeOfTriangle().begin(), planes.planeOfTriangle().end(), 0), 0);
}

TEST(ReceiverPlanes, areNotMadeOfCurvedSurfaces)
{
  // A paraboloid over a floor.
  Prop bowl{ makePlane(2.0, 200) };
  for (glm::dvec3& point : bowl.mesh.points)
  {
    point.z = 0.1 * (point.x * point.x + point.y * point.y);
  }
  const ReceiverPlanes planes =
    planesOf(snapshotOf({ patch({ -2.0, -2.0, -1.0 }, 4.0 * x, 4.0 * y), bowl }));
  ASSERT_EQ(planes.planes().size(), 1u);
  EXPECT_NEAR(planes.planes()[0].area, 16.0, 1e-5);
}

TEST(ReceiverPlanes, followChanges)
{
  Occluders occluders = snapshotOf({ patch(glm::dvec3(0.0), x, y), patch(z, x, y) });
  ReceiverPlanes planes = planesOf(occluders);
  EXPECT_EQ(planes.planes().size(), 2u);
  // While versions stay, nothing is read again; with a new version it is.
  const std::uint64_t version = occluders.positionsVersion;
  moveSurface(occluders, 1, -z);
  const std::uint64_t moved = std::exchange(occluders.positionsVersion, version);
  planes.update(occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 2u);
  occluders.positionsVersion = moved;
  planes.update(occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 1u);
}

TEST(ReceiverPlanes, haveSliversThatLookElsewhere)
{
  // Rounding may turn a triangle that is no wider than its corners' error any way. This one stands
  // upright, like a wall whose direction counts.
  const ReceiverPlanes planes = planesOf(snapshotOf({ patch(z, 2.0 * x, 2.0 * y),
    patch(5.0 * y, x, z), patch(z + y, x, 0x1p-23 * z), patch(z + y, x, 0x1p-20 * z) }));
  EXPECT_EQ(planes.planes().size(), 2u);
  EXPECT_EQ(planes.planeOfTriangle(), (std::vector<std::uint8_t>{ 1, 1, 2, 2, 1, 1, 0, 0 }));
}

TEST(ReceiverPlanes, areTheLargestOfMany)
{
  std::vector<Prop> props;
  for (int i = 0; i < 200; ++i)
  {
    props.push_back(patch(0.1 * i * z, (1.0 + 0.001 * i) * x, y));
  }
  const Occluders occluders = snapshotOf(props);
  ReceiverPlanes planes = planesOf(occluders);
  ASSERT_EQ(planes.planes().size(), static_cast<std::size_t>(mostPlanes));
  for (std::size_t i = 0; i < planes.planes().size(); ++i)
  {
    EXPECT_NEAR(planes.planes()[i].area, 1.199 - 0.001 * static_cast<double>(i), 1e-6);
  }
  planes.update(occluders, 3);
  ASSERT_EQ(planes.planes().size(), 3u);
  EXPECT_NEAR(planes.planes()[2].area, 1.197, 1e-6);
  EXPECT_EQ(*std::max_element(planes.planeOfTriangle().begin(), planes.planeOfTriangle().end()), 3);
}

} // namespace
} // namespace gnomon::test
