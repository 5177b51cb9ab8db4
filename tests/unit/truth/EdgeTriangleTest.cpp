// Triangles that rays leave for certain, under any rounding of a tracer's signs.

#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "shadowtech/penumbra/EdgeTree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::test
{
namespace
{

/// The unit roundoff of float.
constexpr double unit = 1.0 / 16777216.0;

/// A triangle of the tree, with the quantities of docs/theory/exact_penumbrae.md.
struct Known
{
  const EdgeTriangle& triangle;
  const std::array<glm::vec3, 3>& corners; ///< centred
  glm::dvec3 extent;                       ///< of its box

  /// Return the distance of its corners from a start, axis by axis.
  glm::dvec3 reach(const glm::dvec3& start) const
  {
    glm::dvec3 reach(0.0);
    for (const glm::vec3& corner : this->corners)
    {
      reach = glm::max(reach, glm::abs(glm::dvec3(corner) - start));
    }
    return reach;
  }
  /// Return the error bound of T, or of N . D for a direction in place of the reach: 11u (r_x YZ +
  /// r_y ZX + r_z XY).
  double rounding(const glm::dvec3& reach) const
  {
    const glm::dvec3& e = this->extent;
    return 11.0 * unit * glm::dot(reach, glm::dvec3(e.y * e.z, e.z * e.x, e.x * e.y));
  }
  /// Return the least N . D: 128u r^2 |D|.
  static double leastAlong(const glm::dvec3& reach, const glm::dvec3& direction)
  {
    return 128.0 * unit * glm::dot(reach, reach) * glm::length(direction);
  }
  /// The ratio of N, twice the area vector, to EdgeTriangle::normal.
  double longest() const { return static_cast<double>(this->triangle.longest); }
  /// True if rays from a start leave the triangle, in one direction.
  bool isLeft(const glm::dvec3& start, const glm::dvec3& direction) const
  {
    return this->triangle.isLeft(glm::dvec2(this->triangle.behind(start)), this->reach(start),
      glm::dvec2(glm::dot(direction, this->triangle.normal)), glm::length(direction));
  }
};

/// Return triangles of all shapes, slivers among them, around the middle of coordinates and far
/// from it.
void forEachTriangle(const std::function<void(const Known&)>& visit)
{
  for (const double away : { 0.0, 20.0 })
  {
    const glm::dvec3 middle(away);
    const Occluders occluders =
      makeOccluders({ { makeTriangleSoup(300, 1), at(middle) }, { makePlane(0.1), at(-middle) } });
    EdgeTree tree;
    tree.update(occluders);
    for (std::uint32_t place = 0; place < tree.size(); ++place)
    {
      const EdgeTree::Record record = tree.record(place);
      if (record.opaque)
      {
        continue; // a needle
      }
      const std::array<glm::vec3, 3>& corners = tree.corners(record.number);
      const glm::dvec3 lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
      const glm::dvec3 upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
      visit({ tree.triangle(record.number), corners, upper - lower });
    }
  }
}

glm::dvec3 pointOn(const Known& known, Random& random)
{
  const double a = uniform(random, 0.0, 1.0);
  const double b = uniform(random, 0.0, 1.0 - a);
  return glm::dvec3(known.corners[0]) * (1.0 - a - b) + glm::dvec3(known.corners[1]) * a +
    glm::dvec3(known.corners[2]) * b;
}

/// The results of Embree's robust test for a ray, in float, without fused operations.
struct Found
{
  float plane; ///< T, which is (corner - start) . N
  float along; ///< N . D
};

/// Return the normal of three sides: per component, the one with the smaller products.
glm::vec3 stableNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
  const glm::vec3 ofAb(a.z * b.y, a.x * b.z, a.y * b.x);
  const glm::vec3 ofBc(b.z * c.y, b.x * c.z, b.y * c.x);
  const glm::vec3 ab = glm::vec3(a.y * b.z, a.z * b.x, a.x * b.y) - ofAb;
  const glm::vec3 bc = glm::vec3(b.y * c.z, b.z * c.x, b.x * c.y) - ofBc;
  return glm::mix(bc, ab, glm::lessThan(glm::abs(ofAb), glm::abs(ofBc)));
}

Found findInFloat(const Known& known, const glm::vec3& start, const glm::vec3& direction)
{
  const glm::vec3 a = known.corners[0] - start;
  const glm::vec3 b = known.corners[1] - start;
  const glm::vec3 c = known.corners[2] - start;
  const glm::vec3 normal = stableNormal(c - a, a - b, b - c);
  return { glm::dot(a, normal), glm::dot(normal, direction) };
}

/// Return a number within [-most, most] that is more often small, since rounding is mostly far from
/// its bound.
double mostlySmall(Random& random, double most)
{
  return most * std::pow(uniform(random, -1.0, 1.0), 3);
}

/// Counts of the rays for whose starts or directions rounding matters.
struct Tried
{
  std::size_t left = 0;   ///< rays that leave their triangle for certain
  std::size_t turned = 0; ///< of these, rays that in float seem not to
};

/// Try a ray. If it leaves the triangle for certain, a tracer must not find that it goes to it.
void tryRay(const Known& known, const glm::vec3& start, const glm::vec3& direction, Tried& tried)
{
  const double behind = known.triangle.behind(start);
  const double along = glm::dot(glm::dvec3(direction), known.triangle.normal);
  const Found found = findInFloat(known, start, direction);
  const bool meets =
    (found.plane >= 0.0f) == (found.along >= 0.0f) || found.plane == 0.0f || found.along == 0.0f;
  const bool left = known.isLeft(start, direction);
  EXPECT_FALSE(left && meets) << behind << " behind and " << along << " along seem " << found.plane
                              << " and " << found.along;
  tried.left += left ? 1 : 0;
  tried.turned += meets && behind * along < 0.0 ? 1 : 0;
}

/// Starts in a triangle's box, within some roundings of its plane, with rays that go away from it.
TEST(EdgeTriangle, isNotLeftWhereRoundingMayPutAStartOnItsOtherSide)
{
  Random random(1);
  Tried tried;
  forEachTriangle(
    [&](const Known& known)
    {
      const glm::dvec3 normal = glm::normalize(known.triangle.normal);
      for (int i = 0; i < 200; ++i)
      {
        const glm::dvec3 point = pointOn(known, random);
        const double off = known.rounding(known.reach(point)) / known.longest() /
          static_cast<double>(known.triangle.height);
        const glm::vec3 start(point + mostlySmall(random, 4.0 * off) * normal);
        const double side = known.triangle.behind(start) > 0.0 ? -1.0 : 1.0;
        const glm::vec3 direction(
          side * uniform(random, 0.2, 5.0) * (normal + 0.5 * unitVector(random)));
        tryRay(known, start, direction, tried);
      }
    });
  EXPECT_GT(tried.left, 1000u);
  EXPECT_GT(tried.turned, 1000u);
}

/// Rays along a triangle's plane, to within some roundings, from starts off the plane.
TEST(EdgeTriangle, isNotLeftWhereRoundingMayTurnARayToIt)
{
  Random random(2);
  Tried tried;
  forEachTriangle(
    [&](const Known& known)
    {
      const glm::dvec3 normal = glm::normalize(known.triangle.normal);
      for (int i = 0; i < 200; ++i)
      {
        const glm::dvec3 point = pointOn(known, random);
        const double height = static_cast<double>(known.triangle.height);
        const glm::vec3 start(
          point + (random() % 2 ? 1.0 : -1.0) * uniform(random, 0.1, 0.3) * height * normal);
        const glm::dvec3 inPlane =
          uniform(random, 0.2, 5.0) * glm::normalize(glm::cross(normal, unitVector(random)));
        const double off = known.rounding(glm::abs(inPlane)) / known.longest() / height;
        const glm::vec3 direction(inPlane + mostlySmall(random, off) * normal);
        tryRay(known, start, direction, tried);
        tryRay(
          known, start, glm::vec3(inPlane + 1e-2 * uniform(random, -1.0, 1.0) * normal), tried);
      }
    });
  EXPECT_GT(tried.left, 1000u);
  EXPECT_GT(tried.turned, 1000u);
}

/// From twice the error of T on, and from 128u r^2 |D| on.
TEST(EdgeTriangle, isLeftFromItsBoundsOn)
{
  Random random(3);
  forEachTriangle(
    [&](const Known& known)
    {
      const glm::dvec3 start = pointOn(known, random) +
        0.1 * static_cast<double>(known.triangle.height) * unitVector(random);
      const glm::dvec3 reach = known.reach(start);
      const glm::dvec3 direction = uniform(random, 0.2, 5.0) * unitVector(random);
      const double leastBehind = 2.0 * known.rounding(reach) / known.longest();
      const double leastAlong = Known::leastAlong(reach, direction) / known.longest();
      const auto isLeft = [&](const glm::dvec2& behind, const glm::dvec2& along)
      { return known.triangle.isLeft(behind, reach, along, glm::length(direction)); };
      for (const double side : { -1.0, 1.0 })
      {
        const auto isLeftBy = [&](double behind, double along) {
          return isLeft(
            glm::dvec2(side * behind * leastBehind), glm::dvec2(-side * along * leastAlong));
        };
        EXPECT_TRUE(isLeftBy(1.001, 1.001));
        EXPECT_FALSE(isLeftBy(0.999, 1.001));
        EXPECT_FALSE(isLeftBy(1.001, 0.999));
        EXPECT_FALSE(isLeftBy(1.001, -1.001));
        EXPECT_FALSE(isLeftBy(-1.001, 1.001));
      }
      // The result for all of several rays.
      const glm::dvec2 certain(1.001, 2.0);
      const glm::dvec2 uncertain(0.999, 2.0);
      EXPECT_TRUE(isLeft(leastBehind * certain, -leastAlong * glm::dvec2(2.0, 1.001)));
      EXPECT_FALSE(isLeft(leastBehind * uncertain, -leastAlong * glm::dvec2(2.0, 1.001)));
      EXPECT_FALSE(isLeft(leastBehind * certain, -leastAlong * glm::dvec2(2.0, 0.999)));
      EXPECT_TRUE(isLeft(-leastBehind * glm::dvec2(2.0, 1.001), leastAlong * certain));
      EXPECT_FALSE(isLeft(-leastBehind * glm::dvec2(2.0, 0.999), leastAlong * certain));
      EXPECT_FALSE(isLeft(-leastBehind * glm::dvec2(2.0, 1.001), leastAlong * uncertain));
    });
}

} // namespace
} // namespace gnomon::test
