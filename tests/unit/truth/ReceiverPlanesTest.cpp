#include "shadowtech/planar/ReceiverPlanes.h"

#include "SyntheticScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::test
{
namespace
{

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
