// Compare vtkGnomonVisibilityFilter with tests of every triangle in double precision, and with
// pictures.

#include "DataMeshes.h"
#include "RandomScenes.h"
#include "VtkMessages.h"
#include "plugin/PassScene.h"

#include "shadowtech/base/ShadowRay.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>

namespace gnomon::test
{
namespace
{

using Filter = vtkGnomonVisibilityFilter;

/// True if a triangle blocks an endless ray (Moeller and Trumbore 1997).
bool blocks(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& origin,
  const glm::dvec3& direction)
{
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 across = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0.0)
  {
    return false;
  }
  const glm::dvec3 from = origin - a;
  const double u = glm::dot(from, across) / determinant;
  const glm::dvec3 other = glm::cross(from, ab);
  const double v = glm::dot(direction, other) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, other) / determinant > 0.0;
}

/// Return the smallest distance between a ray and a segment.
double distanceToEdge(
  const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b)
{
  // Closest points of two lines (Ericson, section 5.1.8); along is a unit vector.
  const glm::dvec3 edge = b - a;
  const glm::dvec3 from = origin - a;
  const double length = glm::dot(edge, edge);
  const double both = glm::dot(direction, edge);
  const double denominator = length - both * both;
  const double f = glm::dot(edge, from);
  const double c = glm::dot(direction, from);
  double s = denominator > 0.0 ? std::max(0.0, (both * f - c * length) / denominator) : 0.0;
  const double t = glm::clamp((both * s + f) / length, 0.0, 1.0);
  s = std::max(0.0, glm::dot(a + t * edge - origin, direction));
  return glm::distance(origin + s * direction, a + t * edge);
}

/// Return the largest offset of a triangle's shadow rays from it; large for a sliver (ShadowRay.h).
double startOffset(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
  const glm::vec3 area = glm::cross(b - a, c - a);
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  return shadowRayOffset(
    planeNoise(glm::normalize(area), largest, extent, glm::length(area)), 0.0f);
}

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
TEST(VisibilityOracle, AgreesButForRaysThatTouchEdges)
{
  const std::vector<OracleScene> scenes = oracleScenes();
  std::size_t allRays = 0;
  std::size_t allDifferent = 0;
  std::size_t ofSlivers = 0;
  double farthest = 0.0;
  for (const OracleScene& scene : scenes)
  {
    const Mesh& mesh = scene.mesh;
    const std::size_t cells = mesh.triangles.size();
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

      std::atomic<std::size_t> traced{ 0 };
      std::vector<double> distances(cells * directions.size(), -1.0); // of rays that differ
      tbb::parallel_for(std::size_t(0), cells,
        [&](std::size_t cell)
        {
          const glm::uvec3& own = mesh.triangles[cell];
          const glm::dvec3& a = mesh.points[own.x];
          const glm::dvec3& b = mesh.points[own.y];
          const glm::dvec3& c = mesh.points[own.z];
          const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
          const glm::dvec3 origin = (a + b + c) / 3.0;
          for (std::size_t i = 0; i < directions.size(); ++i)
          {
            const glm::dvec3& direction = directions[i];
            if (glm::dot(normal, direction) < 1e-5)
            {
              continue; // turned away, or along the surface
            }
            ++traced;
            bool lit = true;
            for (std::size_t other = 0; lit && other < cells; ++other)
            {
              const glm::uvec3& corners = mesh.triangles[other];
              lit = other == cell ||
                !blocks(mesh.points[corners.x], mesh.points[corners.y], mesh.points[corners.z],
                  origin, direction);
            }
            const auto byte = static_cast<unsigned int>(
              bits->GetComponent(static_cast<vtkIdType>(cell), static_cast<int>(i / 8)));
            if (lit == ((byte >> i % 8 & 1u) != 0))
            {
              continue;
            }
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::uvec3& corners : mesh.triangles)
            {
              for (int corner = 0; corner < 3; ++corner)
              {
                nearest = std::min(nearest,
                  distanceToEdge(origin, direction, mesh.points[corners[corner]],
                    mesh.points[corners[(corner + 1) % 3]]));
              }
            }
            distances[cell * directions.size() + i] = nearest;
          }
        });
      rays += traced;
      for (std::size_t i = 0; i < distances.size(); ++i)
      {
        if (distances[i] >= 0.0)
        {
          ++allDifferent;
          farthest = std::max(farthest, distances[i]);
          const glm::uvec3& own = mesh.triangles[i / directions.size()];
          const double offset =
            startOffset(mesh.points[own.x], mesh.points[own.y], mesh.points[own.z]);
          // Plus a few units in the last place of the scene's coordinates.
          EXPECT_LT(distances[i], 8e-6 + offset) << scene.name;
          ofSlivers += distances[i] >= 8e-6 ? 1 : 0;
        }
      }
    }
    allRays += rays;
  }
  std::cout << allRays << " rays, " << allDifferent << " differ, up to " << farthest
            << " from an edge, " << ofSlivers << " of slivers\n";
  EXPECT_LE(static_cast<double>(allDifferent), 2.0 + 5e-6 * static_cast<double>(allRays));
}

class VisibilityPicture : public PassTest
{
};

/// A tiny cell at each pixel's receiver has the visibility that the picture shows.
TEST_F(VisibilityPicture, ShowsWhatCellsSee)
{
  const auto floor = floorOf({ -4.0, -4.0 }, { 4.0, 4.0 }, 8);
  const auto ball = polyData(makeSphere(24, 48), { 0.3, 0.2, 1.4 });
  const auto box = polyData(makeBox({ -2.0, -1.5, 0.0 }, { -1.2, 1.0, 1.1 }));
  const auto compare = [&](bool isLamp)
  {
    PassScene scene(256, 256);
    for (vtkPolyData* data : { floor.Get(), ball.Get(), box.Get() })
    {
      scene.add(data);
    }
    vtkLight* const light = isLamp ? scene.addSpot({ 3.0, 2.0, 4.0 }, { 0.0, 0.0, 0.0 }, 20.0)
                                   : scene.addSun({ -0.6, -0.3, -1.0 });
    scene.lookFrom({ 3.0, -6.0, 6.0 });
    scene.pass->SetTechnique("raytraced");
    scene.pass->SmoothTerminatorsOff();
    const VisibilityImages& kept = drawKept(scene);

    Mesh cells;
    std::vector<float> expected;
    for (std::size_t i = 0; i < kept.coverage.size(); ++i)
    {
      const glm::dvec3 normal(kept.normalX[i], kept.normalY[i], kept.normalZ[i]);
      if (kept.coverage[i] < 0.5f)
      {
        continue;
      }
      const glm::dvec3 at = positionOf(kept, i);
      const glm::dvec3 x = 1e-3 *
        glm::normalize(
          glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
      const glm::dvec3 y = glm::cross(normal, x);
      const auto first = static_cast<std::uint32_t>(cells.points.size());
      cells.points.insert(
        cells.points.end(), { at + x, at - 0.5 * x + 0.75 * y, at - 0.5 * x - 0.75 * y });
      cells.triangles.emplace_back(first, first + 1, first + 2);
      expected.push_back(kept.visibility.at(0)[i]);
    }
    vtkNew<Filter> filter;
    filter->SetInputData(polyData(cells));
    for (vtkPolyData* data : { floor.Get(), ball.Get(), box.Get() })
    {
      filter->AddInputData(1, data);
    }
    filter->ReceiversCastOff();
    filter->AddLight(light);
    filter->Update();
    const std::vector<double> fraction = arrayOf(filter, Filter::GetLitFractionName());
    ASSERT_EQ(fraction.size(), expected.size());
    std::size_t different = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      different += std::abs(fraction[i] - expected[i]) > 0.5 ? 1 : 0;
      lit += expected[i] > 0.5f ? 1 : 0;
    }
    EXPECT_GT(lit, 5000u);
    EXPECT_GT(expected.size() - lit, 5000u);
    EXPECT_LE(different, 3u) << "of " << expected.size();
  };
  compare(false);
  compare(true);
}

} // namespace
} // namespace gnomon::test
