// Compare vtkGnomonVisibilityFilter with tests of every triangle in double precision.

#include "DataMeshes.h"
#include "RandomScenes.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>

#include <atomic>
#include <cstdlib>
#include <string>

namespace gnomon::test
{
namespace
{

using Filter = vtkGnomonVisibilityFilter;

/// A scene of triangles that all cast and receive.
struct OracleScene
{
  std::string name;
  Mesh mesh;
};

Mesh joined(const std::vector<Mesh>& meshes)
{
  Mesh all;
  for (const Mesh& mesh : meshes)
  {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    for (const glm::uvec3& triangle : mesh.triangles)
    {
      all.triangles.push_back(triangle + first);
    }
  }
  return all;
}

Mesh moved(Mesh mesh, const glm::dvec3& by)
{
  for (glm::dvec3& point : mesh.points)
  {
    point = glm::dvec3(glm::vec3(point + by)); // rounded to float like the filter's snapshot
  }
  return mesh;
}

std::vector<OracleScene> oracleScenes()
{
  const glm::dvec3 none(0.0);
  Random random(8);
  std::vector<Mesh> town = { moved(makePlane(12.0, 6), none) };
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec3 at(uniform(random, -5.0, 5.0), uniform(random, -5.0, 5.0), 0.0);
    const glm::dvec3 size(
      uniform(random, 0.2, 0.8), uniform(random, 0.2, 0.8), uniform(random, 0.5, 3.0));
    town.push_back(moved(makeBox(at, at + size), none));
  }
  return {
    { "hills", moved(makeTerrain(10.0, 16, 3.0), none) },
    { "soup",
      joined(
        { moved(makePlane(3.0, 8), none), moved(makeTriangleSoup(300, 7), { -0.5, -0.5, 0.2 }) }) },
    { "balls",
      joined({ moved(makePlane(6.0, 8), none), moved(makeSphere(8, 16), { 0, 0, 1.5 }),
        moved(makeSphere(6, 12, 0.2), { 1.5, 0.5, 1.2 }) }) },
    { "town", joined(town) },
  };
}

/// Return the rays of each scene. GNOMON_ORACLE_RAYS is the number over all scenes.
std::size_t raysOfScene(std::size_t scenes)
{
  const char* const wish = std::getenv("GNOMON_ORACLE_RAYS");
  return static_cast<std::size_t>(
    (wish ? std::atof(wish) : 200000.0) / static_cast<double>(scenes));
}

/// The oracle's ray starts in the middle of a cell, without an offset, and skips that cell.
TEST(VisibilityOracle, AgreesOnEachRay)
{
  const std::vector<OracleScene> scenes = oracleScenes();
  for (const OracleScene& scene : scenes)
  {
    const Mesh& mesh = scene.mesh;
    const std::size_t cells = mesh.triangles.size();
    std::vector<CastingTriangle> triangles;
    for (const glm::uvec3& corners : mesh.triangles)
    {
      triangles.push_back(
        { 0, 0, { mesh.points[corners.x], mesh.points[corners.y], mesh.points[corners.z] } });
    }
    // A few directions at a time, since many bits take memory.
    std::size_t rays = 0;
    for (unsigned int seed = 1; rays < raysOfScene(scenes.size()); ++seed)
    {
      Random random(seed);
      std::vector<glm::dvec3> directions;
      vtkNew<Filter> filter;
      filter->SetInputData(polyData(mesh));
      filter->ComputeBitsOn();
      for (int i = 0; i < 64; ++i)
      {
        directions.push_back(unitVector(random));
        filter->AddDirection(&directions.back().x);
      }
      filter->Update();
      vtkDataArray* const bits = filter->GetOutput()->GetCellData()->GetArray("Bits");
      ASSERT_NE(bits, nullptr);
      ASSERT_EQ(bits->GetNumberOfTuples(), static_cast<vtkIdType>(cells));

      std::atomic<std::size_t> traced{ 0 }, different{ 0 };
      tbb::parallel_for(std::size_t(0), cells,
        [&](std::size_t cell)
        {
          const auto& [a, b, c] = triangles[cell].corners;
          const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
          const glm::dvec3 origin = (a + b + c) / 3.0;
          for (std::size_t i = 0; i < directions.size(); ++i)
          {
            if (glm::dot(normal, directions[i]) < 1e-5)
            {
              continue; // turned away, or along the surface
            }
            bool lit = true;
            for (std::size_t other = 0; lit && other < cells; ++other)
            {
              const auto hit = meet(triangles[other], origin, directions[i]);
              lit = other == cell || !hit || !hit->isInside() || hit->at <= 0.0;
            }
            const auto byte = static_cast<unsigned int>(
              bits->GetComponent(static_cast<vtkIdType>(cell), static_cast<int>(i / 8)));
            different += lit != ((byte >> i % 8 & 1u) != 0) ? 1 : 0;
            ++traced;
          }
        });
      rays += traced;
      EXPECT_LE(different, traced / 200000) << scene.name << ": rays that touch edges";
    }
  }
}

} // namespace
} // namespace gnomon::test
