// The curved surface above a facet that is shaded with its corners' normals.

#include "shadowtech/base/SmoothFacet.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>

using namespace gnomon;

namespace
{

using Corners = std::array<glm::dvec3, 3>;
using Normals = std::array<glm::vec3, 3>;

struct Above
{
  float height;
  glm::vec3 normal;
};

Above lookAbove(const Corners& corners, const Normals& normals, const glm::dvec3& point)
{
  const glm::vec3 position(point);
  Above above{};
  SmoothFacet(corners, normals)
    .look(1, { &position.x, &position.y, &position.z }, &above.height,
      { &above.normal.x, &above.normal.y, &above.normal.z });
  return above;
}

glm::dvec3 onUnitSphere(double angle, double azimuth)
{
  return { std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
    std::cos(angle) };
}

/// A facet of the unit ball: its corners are at this angle from z.
struct FacetOfBall
{
  Corners corners;
  Normals normals;

  explicit FacetOfBall(double angle)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->corners[i] = onUnitSphere(angle, static_cast<double>(i) * glm::two_pi<double>() / 3.0);
      this->normals[i] = this->corners[i];
    }
  }
};

/// Return the corners' normals of a triangle of a surface under a matrix; nothing if it is flat.
std::optional<Normals> normalsUnder(const glm::dmat4& matrix, const FacetOfBall& facet, bool back)
{
  Occluders occluders;
  Surface surface;
  surface.vertexCount = 3;
  surface.triangleCount = 1;
  surface.pointNormals.assign(facet.normals.begin(), facet.normals.end());
  surface.centredFromNormals = glm::mat3(glm::dmat3(matrix));
  occluders.surfaces.push_back(surface);
  occluders.triangles.emplace_back(0, 1, 2);
  Corners centred;
  for (std::size_t i = 0; i < 3; ++i)
  {
    centred[i] = matrix * glm::dvec4(facet.corners[i], 1.0);
  }
  const glm::dvec3 normal =
    glm::normalize(glm::cross(centred[1] - centred[0], centred[2] - centred[0]));
  return cornerNormals(occluders, { 0, 0, 0 }, back ? -normal : normal, back);
}

/// True if a facet is curved as a triangle of a surface with normals.
bool isCurved(const FacetOfBall& facet, bool fromBack)
{
  return normalsUnder(glm::dmat4(1.0), facet, fromBack).has_value();
}

} // namespace

TEST(SmoothFacet, meetsTheCorners)
{
  const FacetOfBall facet(0.4);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Above above = lookAbove(facet.corners, facet.normals, facet.corners[i]);
    EXPECT_NEAR(above.height, 0.0f, 1e-6f);
    EXPECT_LT(glm::distance(above.normal, facet.normals[i]), 1e-6f);
  }
}

// At the middle, each tangent plane is sin^2(angle) away along its normal.
TEST(SmoothFacet, isAboveTheMiddleOfABallsFacet)
{
  for (const double angle : { 0.01, 0.1, 0.4, 1.0 })
  {
    const FacetOfBall facet(angle);
    const double height = std::sin(angle) * std::sin(angle);
    const Above above = lookAbove(facet.corners, facet.normals, { 0.0, 0.0, std::cos(angle) });
    EXPECT_NEAR(above.height, height, 1e-6) << angle;
    EXPECT_NEAR(above.normal.z, 1.0, 1e-6);
    EXPECT_NEAR(SmoothFacet(facet.corners, facet.normals).largestHeight(), height, 1e-6);
  }
}

TEST(SmoothFacet, isNotAboveAHollow)
{
  FacetOfBall facet(0.4);
  for (glm::vec3& normal : facet.normals)
  {
    normal = -normal; // the camera is inside the ball
  }
  EXPECT_LT(lookAbove(facet.corners, facet.normals, { 0.05, -0.02, std::cos(0.4) }).height, 1e-6f);
  EXPECT_LT(SmoothFacet(facet.corners, facet.normals).largestHeight(), 1e-6f);
}

TEST(SmoothFacet, wantsNormalsThatGoWithTheFacet)
{
  FacetOfBall facet(0.3);
  EXPECT_TRUE(isCurved(facet, false));
  EXPECT_TRUE(isCurved(facet, true)); // both sides are visible
  for (const glm::vec3& normal :
    { glm::vec3(1.0f, 0.0f, 0.01f), glm::vec3(0.0f), glm::vec3(std::nanf("")) })
  {
    facet.normals[1] = normal;
    EXPECT_FALSE(isCurved(facet, false));
  }
}

/// The normals of a mapped ball are those of the ellipsoid, also if the matrix mirrors.
TEST(SmoothFacet, takesNormalsAlong)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const FacetOfBall facet(0.3);
  for (int i = 0; i < 50; ++i)
  {
    glm::dmat4 matrix = glm::rotate(
      glm::dmat4(1.0), 3.0 * uniform(random), glm::dvec3(uniform(random), uniform(random), 1.0));
    matrix = glm::scale(matrix, glm::dvec3(1.5 + uniform(random), 1.2, 1.0));
    const bool mirrors = i % 2 == 1;
    if (mirrors)
    {
      matrix = glm::scale(matrix, glm::dvec3(-1.0, 1.0, 1.0));
    }
    // A mirrored ball shows its outside as the back.
    const std::optional<Normals> normals = normalsUnder(matrix, facet, mirrors);
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(matrix));
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const glm::dvec3 outward =
        glm::normalize(glm::transpose(inverse) * glm::dvec3(facet.normals[corner]));
      if (mirrors)
      {
        EXPECT_FALSE(normals.has_value()); // VTK turns them inwards
      }
      else
      {
        ASSERT_TRUE(normals.has_value());
        EXPECT_LT(glm::distance(glm::dvec3((*normals)[corner]), outward), 1e-6);
      }
    }
  }
}
