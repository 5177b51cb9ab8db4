// Cells of conservative maps, baked in bands of rows on all cores, against all shapes drawn one
// after another.

#include "shadowtech/exact/CellsOnCpu.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

/// True if all used values are equal. The values of a texel whose depths a triangle spoils are not
/// used, and depend on the order of shapes.
bool areSame(const Cell& a, const Cell& b)
{
  const bool spoilt = a.sharpEnd == -infinity && b.sharpEnd == -infinity;
  return a.nearest == b.nearest && a.contained == b.contained && a.sharpEnd == b.sharpEnd &&
    (spoilt || (a.climb == b.climb && a.noise == b.noise)) && a.first == b.first &&
    a.second == b.second;
}

std::string textOf(const Cell& cell)
{
  std::ostringstream text;
  text << "N " << cell.nearest << ", C " << cell.contained << ", G " << cell.climb << ", noise "
       << cell.noise << ", E' " << cell.sharpEnd << ", layers " << cell.first << " and "
       << cell.second;
  return text.str();
}

/// @return the number of filled texels
std::size_t expectSame(const std::vector<Cell>& cells, const std::vector<Cell>& expected, int width,
  const std::string& what)
{
  EXPECT_EQ(cells.size(), expected.size()) << what;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < std::min(cells.size(), expected.size()); ++i)
  {
    filled += expected[i].nearest < infinity ? 1 : 0;
    EXPECT_TRUE(areSame(cells[i], expected[i]))
      << what << ": texel " << i % static_cast<std::size_t>(width) << ", "
      << i / static_cast<std::size_t>(width) << ": " << textOf(cells[i])
      << "; expected: " << textOf(expected[i]);
  }
  return filled;
}

/// Return the cells of a whole map, from its casters' shapes one after another.
std::vector<Cell> drawnOneByOne(
  const CasterScene& scene, const CasterEdges& edges, int size, Covering covering)
{
  std::mutex mutex;
  std::vector<BandItem> triangles;
  const MapCasters casters(scene, edges, covering,
    [&](const BandItem& triangle, const MapPolygon&)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      triangles.push_back(triangle);
    });
  if (casters.blind())
  {
    return {};
  }
  const double margin = casters.margin();
  const Span rows{ 0, size - 1 };
  std::vector<Cell> cells(static_cast<std::size_t>(size * size));
  casters.placements().visitAll([&](const Placement& placement)
    { return casters.edgeCount(placement); },
    [&](std::uint32_t placement, std::uint32_t i)
    {
      MapSegment found;
      if (casters.segment({ placement, i }, found))
      {
        const std::lock_guard<std::mutex> lock(mutex);
        drawSegment(found, margin, size, rows, cells.data());
      }
    });
  const auto visit = [&](const auto& is, const auto& draw)
  {
    for (const BandItem& triangle : triangles)
    {
      const MapPolygon polygon = casters.polygon(triangle);
      if (is(polygon))
      {
        draw(triangle, polygon, PolygonOnTexels(polygon, margin, rows));
      }
    }
  };
  const auto spoils = [](const MapPolygon& polygon) { return polygon.role.poison; };
  const auto faces = [](const MapPolygon& polygon) { return polygon.facing != 0; };
  const auto hasRing = [&](const MapPolygon& polygon)
  { return covering != Covering::Triangle && polygon.role.covers; };
  const auto draw = [&](const BandItem&, const MapPolygon& polygon, const PolygonOnTexels& onTexels)
  { drawPolygon(polygon, onTexels, size, rows, cells.data()); };
  visit(spoils, draw);
  visit(faces, draw);
  visit(hasRing,
    [&](const BandItem& triangle, const MapPolygon& polygon, const PolygonOnTexels&)
    { drawRing(casters.ring(triangle, polygon), margin, size, rows, cells.data()); });
  visit(faces,
    [&](const BandItem&, const MapPolygon&, const PolygonOnTexels& onTexels)
    { drawNoise(onTexels, size, rows, cells.data()); });
  return cells;
}

/// Return the cells of a whole map; none if a caster is at the light.
std::vector<Cell> drawnInBands(
  const CasterScene& scene, const CasterEdges& edges, int size, Covering covering)
{
  std::vector<Cell> cells(static_cast<std::size_t>(size * size));
  return drawCellsOnCpu(
           scene, edges, size, covering, [&](std::size_t i, const Cell& cell) { cells[i] = cell; })
    ? cells
    : std::vector<Cell>();
}

using RandomCells = testing::TestWithParam<const char*>;

TEST_P(RandomCells, areThoseOfShapesOneByOne)
{
  std::size_t filled = 0;
  for (unsigned int seed = 1; seed <= 6; ++seed)
  {
    const RandomPicture picture = makeRandomPicture(GetParam(), seed);
    CasterEdges edges;
    edges.update(picture.occluders);
    const int size = picture.light.mapSizeTexels;
    const auto covering = static_cast<Covering>(seed % 3); // all but Silhouette
    for (const LightView& view : picture.views.views)
    {
      const CasterScene scene =
        casterScene(view, picture.views.box.z > 0.0, size, picture.occluders);
      const std::vector<Cell> cells = drawnInBands(scene, edges, size, covering);
      const std::vector<Cell> expected = drawnOneByOne(scene, edges, size, covering);
      filled += expectSame(cells, expected, size, picture.description);
    }
  }
  EXPECT_GT(filled, 10000u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomCells, testing::ValuesIn(randomSceneNames()), byLetters);

/// Split each triangle into four in its plane. Triangles that met still do.
void subdivide(Occluders& occluders)
{
  const Occluders before = occluders;
  occluders.positionsCentred.clear();
  occluders.triangles.clear();
  for (Surface& surface : occluders.surfaces)
  {
    const std::uint32_t first = surface.firstTriangle, count = surface.triangleCount;
    surface.firstVertex = static_cast<std::uint32_t>(occluders.positionsCentred.size());
    surface.firstTriangle = static_cast<std::uint32_t>(occluders.triangles.size());
    for (std::uint32_t i = first; i < first + count; ++i)
    {
      const auto vertex = static_cast<std::uint32_t>(occluders.positionsCentred.size());
      const auto cornerOf = [&](int k)
      { return before.positionsCentred[before.triangles[i][k % 3]]; };
      for (int k = 0; k < 3; ++k)
      {
        occluders.positionsCentred.push_back(cornerOf(k));
        occluders.positionsCentred.push_back(0.5f * (cornerOf(k) + cornerOf(k + 1)));
      }
      for (const glm::uvec3& corners :
        { glm::uvec3(0, 1, 5), glm::uvec3(1, 2, 3), glm::uvec3(5, 3, 4), glm::uvec3(1, 3, 5) })
      {
        occluders.triangles.push_back(vertex + corners);
      }
    }
    surface.vertexCount = 6 * count;
    surface.triangleCount = 4 * count;
  }
}

/// A limited number of a band's triangles is stored for their noise, and the others are visited
/// again.
TEST(Cells, areThoseOfShapesOneByOneWhereManyTrianglesLieInABand)
{
  RandomPicture picture = makeRandomPicture("touching boxes", 3);
  while (picture.occluders.triangles.size() < 40000)
  {
    subdivide(picture.occluders);
  }
  CasterEdges edges;
  edges.update(picture.occluders);
  constexpr int size = 16;
  const LightView& view = picture.views.views.front();
  const CasterScene scene = casterScene(view, picture.views.box.z > 0.0, size, picture.occluders);
  const std::vector<Cell> cells = drawnInBands(scene, edges, size, Covering::Triangle);
  expectSame(
    cells, drawnOneByOne(scene, edges, size, Covering::Triangle), size, picture.description);
  EXPECT_TRUE(
    std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.noise > 0.0f; }));
}

} // namespace
} // namespace gnomon::test
