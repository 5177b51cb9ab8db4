#include "lights/LightSpace.h"

#include "Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
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

TEST(CubeFaces, AreRotationsThatSeeTheirOwnPoints)
{
  Random random(4);
  std::set<int> seen;
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 point = inCube(random);
    const int face = cubeFaceOf(point);
    seen.insert(face);
    const glm::dvec3 inFace = cubeFaceFromLight(face) * point;
    EXPECT_GE(inFace.z, std::abs(inFace.x));
    EXPECT_GE(inFace.z, std::abs(inFace.y));
  }
  EXPECT_EQ(seen.size(), 6u);
  for (int face = 0; face < cubeFaces; ++face)
  {
    expectRigid(cubeFaceFromLight(face));
  }
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

} // namespace
} // namespace gnomon::test
