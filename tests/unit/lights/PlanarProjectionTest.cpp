#include "lights/PlanarProjection.h"

#include "Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test
{
namespace
{

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

// Row 1 of the survey: the ground y = 0, by similar triangles.
TEST(PlanarProjection, ontoTheGroundIsThatOfSimilarTriangles)
{
  const glm::dvec4 ground(0.0, 1.0, 0.0, 0.0);
  Random random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 l(
      uniform(random, -9.0, 9.0), uniform(random, 3.0, 9.0), uniform(random, -9.0, 9.0));
    const glm::dvec3 v(
      uniform(random, -9.0, 9.0), uniform(random, -1.0, 2.9), uniform(random, -9.0, 9.0));
    const glm::dmat4 matrix = planarProjection(ground, glm::dvec4(l, 1.0));
    // Rows (l_y, -l_x, 0, 0), (0, 0, 0, 0), (0, -l_z, l_y, 0), (0, -1, 0, l_y).
    const glm::dmat4 rows = glm::transpose(matrix);
    EXPECT_EQ(rows[0], glm::dvec4(l.y, -l.x, 0.0, 0.0));
    EXPECT_EQ(rows[1], glm::dvec4(0.0));
    EXPECT_EQ(rows[2], glm::dvec4(0.0, -l.z, l.y, 0.0));
    EXPECT_EQ(rows[3], glm::dvec4(0.0, -1.0, 0.0, l.y));

    const glm::dvec3 p = project(ground, glm::dvec4(l, 1.0), v);
    EXPECT_EQ(p.y, 0.0);
    const double x = (l.y * v.x - l.x * v.y) / (l.y - v.y);
    const double z = (l.y * v.z - l.z * v.y) / (l.y - v.y);
    EXPECT_NEAR(p.x, x, 1e-5 * std::abs(x));
    EXPECT_NEAR(p.z, z, 1e-5 * std::abs(z));
    EXPECT_LT(offLine(l, v - l, p), 1e-5);
  }
}

// Survey, row 2: any plane, and parallel rays.
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
