#include "shadowtech/planar/ReceiverPlanes.h"

#include "shadowtech/base/Occluders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::test
{
namespace
{

/// Snapshots of parallelograms.
class Snapshot
{
public:
  /// A surface of cells x cells x 2 triangles.
  Surface& add(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int cells = 1)
  {
    Surface surface;
    surface.firstVertex = static_cast<std::uint32_t>(this->occluders.positionsCentred.size());
    surface.firstTriangle = static_cast<std::uint32_t>(this->occluders.triangles.size());
    for (int j = 0; j <= cells; ++j)
    {
      for (int i = 0; i <= cells; ++i)
      {
        const glm::dvec3 point =
          origin + static_cast<double>(i) / cells * u + static_cast<double>(j) / cells * v;
        this->occluders.positionsCentred.emplace_back(point);
        this->occluders.allCentred.add(point);
      }
    }
    for (int j = 0; j < cells; ++j)
    {
      for (int i = 0; i < cells; ++i)
      {
        const std::uint32_t corner =
          surface.firstVertex + static_cast<std::uint32_t>(j * (cells + 1) + i);
        const auto row = static_cast<std::uint32_t>(cells + 1);
        this->occluders.triangles.emplace_back(corner, corner + 1, corner + row);
        this->occluders.triangles.emplace_back(corner + 1, corner + row + 1, corner + row);
      }
    }
    surface.vertexCount =
      static_cast<std::uint32_t>(this->occluders.positionsCentred.size()) - surface.firstVertex;
    surface.triangleCount =
      static_cast<std::uint32_t>(this->occluders.triangles.size()) - surface.firstTriangle;
    surface.topologyVersion = surface.positionsVersion = ++this->versions_;
    this->occluders.surfaces.push_back(surface);
    this->occluders.topologyVersion = this->occluders.positionsVersion = ++this->versions_;
    return this->occluders.surfaces.back();
  }

  /// Move a surface. The box around all surfaces stays: it may be larger than needed.
  void move(std::size_t number, const glm::vec3& by)
  {
    Surface& surface = this->occluders.surfaces[number];
    for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
    {
      glm::vec3& position = this->occluders.positionsCentred[surface.firstVertex + i];
      position += by;
      this->occluders.allCentred.add(position);
    }
    surface.positionsVersion = this->occluders.positionsVersion = ++this->versions_;
  }

  Occluders occluders;

private:
  std::uint64_t versions_ = 0;
};

const glm::dvec3 x(1.0, 0.0, 0.0);
const glm::dvec3 y(0.0, 1.0, 0.0);
const glm::dvec3 z(0.0, 0.0, 1.0);

TEST(ReceiverPlanes, ofNothingAreNone)
{
  Occluders occluders;
  occluders.topologyVersion = 1;
  ReceiverPlanes planes;
  planes.update(occluders, mostPlanes);
  EXPECT_TRUE(planes.planes().empty());
  EXPECT_EQ(planes.area(), 0.0);
}

TEST(ReceiverPlanes, joinWhatIsCoplanarAcrossSurfacesInOrderOfArea)
{
  Snapshot snapshot;
  snapshot.add(-z, x, y);                          // area 1
  snapshot.add(2.0 * x, 3.0 * y, 1.0 * x);         // z = 0, area 3, its front down
  snapshot.add(-5.0 * x, 1.0 * x, 1.0 * y);        // z = 0, area 1
  snapshot.add(glm::dvec3(0.0), 2.0 * z, 1.0 * x); // y = 0, area 2
  snapshot.add(z, x, y).receives = false;
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
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
    Snapshot snapshot;
    snapshot.add(-0.5 * (u + v), u, v);
    snapshot.add(-0.4 * (u + v) + 1e-5 * size * up, 0.8 * u, 0.8 * v);
    ReceiverPlanes planes;
    planes.update(snapshot.occluders, mostPlanes);
    ASSERT_EQ(planes.planes().size(), 2u) << size;
    EXPECT_LT(planes.planes()[0].thickness, 1e-5 * size);
  }
}

TEST(ReceiverPlanes, findFinelyCutOnesWhole)
{
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.2, -0.4, 1.0));
  const glm::dvec3 u = 40.0 * glm::normalize(glm::cross(up, x));
  const glm::dvec3 v = glm::cross(up, u);
  Snapshot snapshot;
  snapshot.add(glm::dvec3(-30.0, 10.0, 5.0), u, v, 300);
  snapshot.add(glm::dvec3(-30.0, 10.0, 5.0), u, 20.0 * up, 300);
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
  ASSERT_EQ(planes.planes().size(), 2u);
  EXPECT_NEAR(planes.planes()[0].area, 1600.0, 0.01);
  EXPECT_NEAR(planes.planes()[1].area, 800.0, 0.01);
  EXPECT_EQ(std::count(planes.planeOfTriangle().begin(), planes.planeOfTriangle().end(), 0), 0);
}

TEST(ReceiverPlanes, areNotMadeOfCurvedSurfaces)
{
  // A paraboloid over a floor.
  Snapshot snapshot;
  snapshot.add(glm::dvec3(-2.0, -2.0, -1.0), 4.0 * x, 4.0 * y);
  snapshot.add(glm::dvec3(-1.0, -1.0, 0.0), 2.0 * x, 2.0 * y, 200);
  for (std::size_t i = 4; i < snapshot.occluders.positionsCentred.size(); ++i)
  {
    glm::vec3& point = snapshot.occluders.positionsCentred[i];
    point.z = 0.1f * (point.x * point.x + point.y * point.y);
  }
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
  ASSERT_EQ(planes.planes().size(), 1u);
  EXPECT_NEAR(planes.planes()[0].area, 16.0, 1e-5);
}

TEST(ReceiverPlanes, followChanges)
{
  Snapshot snapshot;
  snapshot.add(glm::dvec3(0.0), x, y);
  snapshot.add(z, x, y);
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 2u);
  // While versions stay, nothing is read again; with a new version it is.
  const std::uint64_t version = snapshot.occluders.positionsVersion;
  snapshot.move(1, -z);
  const std::uint64_t moved = std::exchange(snapshot.occluders.positionsVersion, version);
  planes.update(snapshot.occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 2u);
  snapshot.occluders.positionsVersion = moved;
  planes.update(snapshot.occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 1u);
}

TEST(ReceiverPlanes, haveSliversThatLookElsewhere)
{
  // Rounding may turn a triangle that is no wider than its corners' error any way. This one stands
  // upright, like a wall whose direction counts.
  Snapshot snapshot;
  snapshot.add(z, 2.0 * x, 2.0 * y);
  snapshot.add(5.0 * y, x, z);
  snapshot.add(z + y, x, 0x1p-23 * z);
  snapshot.add(z + y, x, 0x1p-20 * z);
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
  EXPECT_EQ(planes.planes().size(), 2u);
  EXPECT_EQ(planes.planeOfTriangle(), (std::vector<std::uint8_t>{ 1, 1, 2, 2, 1, 1, 0, 0 }));
}

TEST(ReceiverPlanes, areTheLargestOfMany)
{
  Snapshot snapshot;
  for (int i = 0; i < 200; ++i)
  {
    snapshot.add(0.1 * i * z, (1.0 + 0.001 * i) * x, y);
  }
  ReceiverPlanes planes;
  planes.update(snapshot.occluders, mostPlanes);
  ASSERT_EQ(planes.planes().size(), static_cast<std::size_t>(mostPlanes));
  for (std::size_t i = 0; i < planes.planes().size(); ++i)
  {
    EXPECT_NEAR(planes.planes()[i].area, 1.199 - 0.001 * static_cast<double>(i), 1e-6);
  }
  planes.update(snapshot.occluders, 3);
  ASSERT_EQ(planes.planes().size(), 3u);
  EXPECT_NEAR(planes.planes()[2].area, 1.197, 1e-6);
  EXPECT_EQ(*std::max_element(planes.planeOfTriangle().begin(), planes.planeOfTriangle().end()), 3);
}

} // namespace
} // namespace gnomon::test
