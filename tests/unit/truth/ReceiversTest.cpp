#include "shadowtech/base/Receivers.h"

#include "SyntheticScene.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/SmoothFacet.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

namespace gnomon::test
{
namespace
{

/// A plane and a cube far from the world's origin, neither along an axis. The cube is inside out,
/// so the camera sees the back of its triangles.
Occluders turnedScene()
{
  const glm::dmat4 turn = glm::rotate(at({ 1e5, -2e5, 3e5 }), 0.5, { 1.0, 0.4, 0.2 });
  Mesh box = makeBox(glm::dvec3(-0.5), glm::dvec3(0.5));
  for (glm::uvec3& triangle : box.triangles)
  {
    std::swap(triangle.y, triangle.z);
  }
  return makeOccluders({ { makePlane(6.0, 3), turn }, { box, turn } });
}
Camera turnedCamera(double parallelHeight = 0.0)
{
  Camera camera{ { 1e5 + 3.0, -2e5 - 5.0, 3e5 + 4.0 }, { 1e5, -2e5, 3e5 } };
  camera.parallelHeight = parallelHeight;
  return camera;
}

/// Return a pixel's side at distance 1.
double pixelSizeOf(const Camera& camera)
{
  return 2.0 * std::tan(0.5 * glm::radians(camera.fovDegrees)) / camera.height;
}

ReceiverPixels project(const View& view, const Occluders& occluders)
{
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  return receivers;
}

/// Expect uncovered pixels to have empty fields, and all numbers to be finite.
void expectNotCovered(const ReceiverPixels& receivers, std::size_t i)
{
  EXPECT_EQ(receivers.surface[i], ReceiverPixels::notCovered);
  for (const std::vector<float>* plane :
    { &receivers.positionX, &receivers.positionY, &receivers.positionZ, &receivers.normalX,
      &receivers.normalY, &receivers.normalZ, &receivers.offset })
  {
    EXPECT_EQ((*plane)[i], 0.0f);
  }
}

/// Return the corners of the triangle that was drawn in a pixel.
std::array<glm::dvec3, 3> drawnCorners(
  const View& view, const Occluders& occluders, std::size_t pixel)
{
  const glm::vec2 fragment = view.images.fragments[pixel];
  const Surface& surface = occluders.surfaces[static_cast<std::size_t>(fragment.x) - 1];
  return castingTriangles(occluders) // which are all
    .at(surface.firstTriangle + static_cast<std::size_t>(fragment.y))
    .corners;
}

/// Return a point's distance inside a triangle from the nearest edge, in the triangle's plane;
/// negative outside.
double inside(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point)
{
  const glm::dvec3 normal =
    glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec3 edge = glm::normalize(corners[(k + 1) % 3] - corners[k]);
    least = std::min(least, glm::dot(glm::cross(normal, edge), point - corners[k]));
  }
  return least;
}

/// Return a point's distance from a pixel's ray, in pixels.
double offRay(const View& view, std::size_t pixel, const glm::dvec3& point)
{
  const PixelRays& rays = view.images.rays;
  const auto x = static_cast<double>(pixel % static_cast<std::size_t>(view.images.width));
  const auto y = static_cast<double>(pixel / static_cast<std::size_t>(view.images.width));
  const glm::dvec3 direction = rays.direction(x, y);
  const glm::dvec3 from = point - rays.origin(x, y);
  const double t = glm::dot(from, direction) / glm::dot(direction, direction);
  return glm::length(from - t * direction) /
    glm::length(rays.originPerRow + t * rays.directionPerRow);
}

TEST(Receivers, AreWhereThePixelsRaysMeetTheirTriangles)
{
  const Occluders occluders = turnedScene();
  for (const double parallelHeight : { 0.0, 8.0 })
  {
    const Camera camera = turnedCamera(parallelHeight);
    const View view = makeView(occluders, camera);
    const ReceiverPixels receivers = project(view, occluders);
    ASSERT_GT(countCovered(receivers), 20000u);
    std::size_t clamped = 0;
    std::size_t small = 0; // offsets
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      if (view.images.fragments[i].x == 0.0f)
      {
        expectNotCovered(receivers, i);
        continue;
      }
      ASSERT_EQ(receivers.surface[i], static_cast<std::uint32_t>(view.images.fragments[i].x) - 1);
      const std::array<glm::dvec3, 3> corners = drawnCorners(view, occluders, i);
      const glm::dvec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      const glm::dvec3 position = glm::dvec3(receivers.position(i));

      // On the triangle, to within the rounding of the position.
      const glm::dvec3 rounding = std::ldexp(1.0, -24) * glm::abs(position);
      ASSERT_LE(std::abs(glm::dot(position - corners[0], normal)),
        1.001 * glm::dot(glm::abs(normal), rounding));
      ASSERT_GE(inside(corners, position), -glm::length(rounding));
      // On the ray, except where the ray passes the triangle: there off by the view's jitter and a
      // step inwards.
      const double off = offRay(view, i, position);
      ASSERT_LT(off, (0.5 * std::sqrt(2.0) + 1.0) / 256.0 + 1e-4);
      clamped += off > 1e-4 ? 1 : 0;

      const glm::dvec3 facing = glm::dvec3(receivers.normal(i));
      ASSERT_NEAR(std::abs(glm::dot(facing, normal)), 1.0, 1e-6);
      ASSERT_NEAR(glm::length(facing), 1.0, 1e-6);
      const PixelRays& rays = view.images.rays;
      const glm::dvec3 direction =
        rays.direction(static_cast<double>(i % 256), static_cast<double>(i / 256));
      ASSERT_LT(glm::dot(facing, direction), 0.0);

      const double depth =
        glm::dot(position - rays.firstOrigin, glm::normalize(rays.direction(127.5, 127.5)));
      const auto footprint = static_cast<float>(
        parallelHeight > 0.0 ? parallelHeight / 256.0 : pixelSizeOf(camera) * depth);
      // A rasteriser's footprint where the ray passes the triangle, else 1/256 of it.
      ASSERT_GT(receivers.offset[i],
        off > 1e-4 ? shadowRayOffset(0.0f, 0.999f * footprint)
                   : shadowRayOffsetInside(0.0f, 0.999f * footprint));
      ASSERT_LT(receivers.offset[i], shadowRayOffset(0.0f, footprint) + 1e-4f);
      small += receivers.offset[i] < shadowRayOffset(0.0f, 0.5f * footprint) ? 1 : 0;
    }
    EXPECT_GT(small, 10 * clamped);
    EXPECT_GT(clamped, 0u); // there are such pixels
  }
}

/// For any triangle that the rasteriser reports, the receiver is a point inside that triangle, and
/// the closest to the pixel's ray. It is only moved a step away from the edge, where it would lie
/// on the neighbour's plane, too.
TEST(Receivers, AreTheClosestPointsOfTrianglesBesideTheRay)
{
  const Occluders occluders = turnedScene();
  for (const double parallelHeight : { 0.0, 8.0 })
  {
    const Camera camera = turnedCamera(parallelHeight);
    View view = makeView(occluders, camera);
    // The triangle of the pixel 1 further right and 2 further up.
    const std::vector<glm::vec2> fragments = view.images.fragments;
    constexpr std::size_t step = 2 * 256 + 1;
    std::size_t passedBy = 0;
    std::copy(fragments.begin() + step, fragments.end(), view.images.fragments.begin());
    const ReceiverPixels receivers = project(view, occluders);
    for (std::size_t i = 0; i + step < receivers.size(); ++i)
    {
      if (view.images.fragments[i].x == 0.0f || i % 256 == 255)
      {
        continue;
      }
      const std::array<glm::dvec3, 3> corners = drawnCorners(view, occluders, i);
      const glm::dvec3 position = glm::dvec3(receivers.position(i));
      ASSERT_GE(inside(corners, position), -std::ldexp(1.0, -24) * glm::length(position));
      const double off = offRay(view, i, position);
      ASSERT_LT(off, std::sqrt(5.0) + 0.01);
      if (off < 0.01)
      {
        continue;
      }
      ++passedBy;
      ASSERT_GT(inside(corners, position), 4.0 * std::ldexp(1.0, -24) * glm::length(position));
      for (std::size_t k = 0; k < 3; ++k)
      {
        for (int part = 0; part < 50; ++part)
        {
          const glm::dvec3 point = glm::mix(corners[k], corners[(k + 1) % 3], part / 50.0);
          ASSERT_GE(offRay(view, i, point), 0.9999 * off - 1.0 / 256.0 - 1e-4);
        }
      }
    }
    EXPECT_GT(passedBy, 500u);
  }
}

TEST(Receivers, FindTheirTrianglesThroughTables)
{
  const Occluders plain = turnedScene();
  View view = makeView(plain, turnedCamera());
  const ReceiverPixels expected = project(view, plain);

  // One drawn surface holds both, the cube first, with a gap in VTK's numbers.
  View shared = view;
  const std::uint32_t planeTriangles = plain.surfaces[0].triangleCount;
  shared.drawnSurfaces = { { { { 3, 12, 1 }, { 20, planeTriangles, 0 } } } };
  for (glm::vec2& fragment : shared.images.fragments)
  {
    fragment.y += fragment.x == 1.0f ? 20.0f : 3.0f;
    fragment.x = fragment.x > 0.0f ? 1.0f : 0.0f;
  }
  EXPECT_EQ(project(shared, plain).surface, expected.surface);
  EXPECT_EQ(project(shared, plain).positionX, expected.positionX);

  // Numbers outside both blocks.
  for (const float primitive : { 2.0f, 15.0f, 19.0f, 20.0f + planeTriangles, -1.0f, 1e30f })
  {
    View astray = shared;
    astray.images.fragments[0] = { 1.0f, primitive };
    expectNotCovered(project(astray, plain), 0);
  }

  // VTK draws a triangle that the snapshot dropped, in front of the plane's triangle.
  Occluders dropped = plain;
  dropped.surfaces[0].triangleOfDrawn.push_back(Surface::noTriangle);
  for (std::uint32_t k = 0; k < planeTriangles; ++k)
  {
    dropped.surfaces[0].triangleOfDrawn.push_back(k);
  }
  View later = view;
  later.drawnSurfaces[0].blocks[0].primitiveCount = planeTriangles + 1;
  for (glm::vec2& fragment : later.images.fragments)
  {
    fragment.y += fragment.x == 1.0f ? 1.0f : 0.0f;
  }
  EXPECT_EQ(project(later, dropped).surface, expected.surface);
  later.images.fragments[0] = { 1.0f, 0.0f };
  expectNotCovered(project(later, dropped), 0);
}

TEST(Receivers, BrokenFragmentsAreNotCovered)
{
  const Occluders occluders = turnedScene();
  const View view = makeView(occluders, turnedCamera());
  const auto middle = static_cast<std::size_t>(128 * 256 + 128);
  const ReceiverPixels expected = project(view, occluders);
  ASSERT_NE(expected.surface[middle], ReceiverPixels::notCovered);
  for (const float broken : { std::numeric_limits<float>::quiet_NaN(),
         std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() })
  {
    for (int component = 0; component < 2; ++component)
    {
      View astray = view;
      astray.images.fragments[middle][component] = broken;
      expectNotCovered(project(astray, occluders), middle);
    }
    View astray = view;
    astray.images.rays.firstOrigin.y = static_cast<double>(broken);
    EXPECT_EQ(countCovered(project(astray, occluders)), 0u);
  }
  View astray = view;
  for (glm::vec2& fragment : astray.images.fragments)
  {
    fragment.x = -fragment.x; // does not receive
  }
  EXPECT_EQ(project(astray, occluders).surface, expected.surface);
  for (const float drawn : { 3.0f, 1e20f, 0.5f })
  {
    astray.images.fragments[middle].x = drawn;
    expectNotCovered(project(astray, occluders), middle);
  }
}

/// If the triangle has no normal, the direction to the camera counts.
TEST(Receivers, TrianglesWithoutAreaFaceTheCamera)
{
  Occluders occluders = turnedScene();
  const View view = makeView(occluders, turnedCamera());
  const auto middle = static_cast<std::size_t>(128 * 256 + 128);
  ASSERT_EQ(project(view, occluders).surface[middle], 1u);
  for (std::uint32_t k = 0; k < 12; ++k)
  {
    glm::uvec3& triangle = occluders.triangles[occluders.surfaces[1].firstTriangle + k];
    triangle.z = triangle.y;
  }
  const ReceiverPixels receivers = project(view, occluders);
  EXPECT_EQ(receivers.surface[middle], 1u);
  const glm::dvec3 toCamera = -glm::normalize(view.images.rays.direction(128.0, 128.0));
  EXPECT_LT(glm::length(glm::dvec3(receivers.normal(middle)) - toCamera), 1e-6);
  EXPECT_GT(receivers.offset[middle], 0.0f);
  // The triangle is reduced to a line: the receiver is its closest point.
  const std::array<glm::dvec3, 3> corners = drawnCorners(view, occluders, middle);
  const double off = offRay(view, middle, glm::dvec3(receivers.position(middle)));
  for (int step = 0; step <= 100; ++step)
  {
    EXPECT_GE(offRay(view, middle, glm::mix(corners[0], corners[1], step / 100.0)), off - 1e-4);
  }
}

TEST(Receivers, TilesAreThePicture)
{
  // More than one tile along each axis, the last ones smaller.
  Camera camera = turnedCamera();
  camera.width = 2 * static_cast<int>(ReceiverTile::mostColumns) + 5;
  camera.height = static_cast<int>(ReceiverTile::mostRows) + 3;
  const Occluders occluders = turnedScene();
  const View view = makeView(occluders, camera);
  ReceiverPixels stored;
  Receivers receivers(view.images, view.drawnSurfaces, occluders, stored);
  const auto gather = [&]
  {
    ReceiverPixels picture;
    picture.resize(camera.width, camera.height);
    std::atomic<std::size_t> pixels = 0;
    receivers.visitTiles(
      [&](const ReceiverTile& tile)
      {
        pixels += tile.size();
        for (std::size_t n = 0; n < tile.size(); ++n)
        {
          const std::size_t row = n / tile.columns;
          const std::size_t column = n % tile.columns;
          const std::size_t i = tile.at(column, row);
          picture.put((tile.firstRow + row) * receivers.width() + tile.firstColumn + column,
            tile.receivers.position(i), tile.receivers.normal(i), tile.receivers.offset[i],
            tile.receivers.surface[i]);
        }
      });
    EXPECT_EQ(pixels, picture.size());
    return picture;
  };
  const auto expectAll = [&](const ReceiverPixels& picture, const ReceiverPixels& all)
  {
    EXPECT_EQ(std::tie(picture.positionX, picture.positionY, picture.positionZ, picture.normalX,
                picture.normalY, picture.normalZ, picture.offset, picture.surface),
      std::tie(all.positionX, all.positionY, all.positionZ, all.normalX, all.normalY, all.normalZ,
        all.offset, all.surface));
  };
  const ReceiverPixels projected = gather();
  EXPECT_EQ(stored.size(), 0u) << "nobody asked for all of them";
  const ReceiverPixels& all = receivers.all();
  EXPECT_GT(countCovered(all), 0u);
  expectAll(projected, all);
  expectAll(gather(), all); // from those that are stored
}

TEST(Receivers, EmptyInputs)
{
  ReceiverPixels receivers;
  receivers.resize(3, 3);
  Receivers({}, {}, {}, receivers).all();
  EXPECT_EQ(receivers.size(), 0u);

  View view = makeView(turnedScene(), turnedCamera());
  EXPECT_EQ(countCovered(project(view, Occluders())), 0u);
  view.drawnSurfaces = { {}, {} };
  EXPECT_EQ(countCovered(project(view, turnedScene())), 0u);
}

// The curved surface above a facet that is shaded with its corners' normals.

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

} // namespace
} // namespace gnomon::test
