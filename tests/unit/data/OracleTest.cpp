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
#include <vector>

namespace gnomon::test
{
namespace
{

using Filter = vtkGnomonVisibilityFilter;

/// Return a random scene's triangles, rounded to float like the filter's snapshot. All cast and
/// receive.
Mesh makeTriangles(const char* name)
{
  Random random(8);
  Mesh all;
  for (const Prop& prop : makeRandomScene(name, random))
  {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (const glm::dvec3& point : prop.mesh.points)
    {
      all.points.emplace_back(glm::vec3(prop.worldFromMesh * glm::dvec4(point, 1.0)));
    }
    for (const glm::uvec3& triangle : prop.mesh.triangles)
    {
      all.triangles.push_back(triangle + first);
    }
  }
  return all;
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
  const std::vector<const char*> scenes{ "spheres", "cups", "folds", "junctions", "terrain",
    "crossing boxes" };
  for (const char* scene : scenes)
  {
    const Mesh mesh = makeTriangles(scene);
    const std::size_t cells = mesh.triangles.size();
    std::vector<CastingTriangle> triangles;
    for (const glm::uvec3& corners : mesh.triangles)
    {
      triangles.push_back(
        { 0, 0, { mesh.points[corners.x], mesh.points[corners.y], mesh.points[corners.z] } });
    }
    // A few directions at a time, since many bits take memory.
    std::atomic<std::size_t> rays{ 0 }, different{ 0 };
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
            ++rays;
          }
        });
    }
    EXPECT_LE(different, rays / 200000) << scene << ": rays that touch edges";
  }
}

} // namespace
} // namespace gnomon::test
