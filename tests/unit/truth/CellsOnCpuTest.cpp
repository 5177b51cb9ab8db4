// Cells of conservative maps, baked in bands of rows on all cores, against all shapes drawn one
// after another.

#include "shadowtech/exact/CellsOnCpu.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <sstream>
#include <string>
#include <tuple>
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

/// @param expected as many as `cells`, from `firstExpected` on
/// @return the number of filled texels
std::size_t expectSame(const std::vector<Cell>& cells, const std::vector<Cell>& expected, int width,
  const std::string& what, std::size_t firstExpected = 0)
{
  EXPECT_LE(firstExpected + cells.size(), expected.size()) << what;
  std::size_t different = 0, filled = 0;
  for (std::size_t i = 0; i < std::min(cells.size(), expected.size() - firstExpected); ++i)
  {
    const Cell& truth = expected[firstExpected + i];
    filled += truth.nearest < infinity ? 1 : 0;
    if (!areSame(cells[i], truth) && ++different == 1)
    {
      ADD_FAILURE() << what << ": texel " << i % static_cast<std::size_t>(width) << ", "
                    << i / static_cast<std::size_t>(width) << ": " << textOf(cells[i])
                    << "; expected: " << textOf(truth);
    }
  }
  EXPECT_EQ(different, 0u) << what << ", of " << filled;
  return filled;
}

std::size_t countOf(int width, Span rows)
{
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.last - rows.first + 1);
}

/// Shapes in the order of drawing.
struct Shapes
{
  std::vector<MapSegment> segments;
  std::vector<MapPolygon> spoiling, triangles;
  std::vector<MapRing> rings;
  double margin = marginTexels;

  std::vector<Cell> drawn(int width, Span rows) const
  {
    std::vector<Cell> cells(countOf(width, rows));
    for (const MapSegment& segment : this->segments)
    {
      drawSegment(segment, this->margin, width, rows, cells.data());
    }
    for (const std::vector<MapPolygon>& polygons : { this->spoiling, this->triangles })
    {
      for (const MapPolygon& polygon : polygons)
      {
        drawPolygon(
          polygon, PolygonOnTexels(polygon, this->margin, rows), width, rows, cells.data());
      }
    }
    for (const MapRing& ring : this->rings)
    {
      drawRing(ring, this->margin, width, rows, cells.data());
    }
    for (const MapPolygon& polygon : this->triangles)
    {
      drawNoise(PolygonOnTexels(polygon, this->margin, rows), width, rows, cells.data());
    }
    return cells;
  }
};

MapSegment segmentBetween(const glm::dvec3& from, const glm::dvec3& to)
{
  MapSegment segment;
  segment.ends = { { { from.x, from.y, from.z }, { to.x, to.y, to.z } } };
  return segment;
}

/// Triangles of all sizes; polygons with more corners, and degenerate ones; edges and rings.
Shapes randomShapes(Random& random, int width)
{
  Shapes shapes;
  shapes.margin = random() % 3 ? marginTexels : uniform(random, marginTexels, largestMargin);
  const auto anyPolygon = [&]
  {
    MapPolygon polygon = polygonWith(randomTriangle(random, width));
    if (random() % 4 == 0) // cuts its corner off
    {
      const auto [a, b, c] = std::tie(polygon.corners[0], polygon.corners[1], polygon.corners[2]);
      const double t = uniform(random, 0.1, 0.9);
      polygon.corners[3] = { c.x + t * (a.x - c.x), c.y + t * (a.y - c.y),
        c.depth + t * (a.depth - c.depth) };
      polygon.corners[2] = { c.x + t * (b.x - c.x), c.y + t * (b.y - c.y),
        c.depth + t * (b.depth - c.depth) };
      polygon.count = 4;
    }
    if (random() % 8 == 0) // on texels' corners
    {
      for (std::size_t i = 0; i < polygon.count; ++i)
      {
        polygon.corners[i].x = std::round(polygon.corners[i].x);
        polygon.corners[i].y = std::round(polygon.corners[i].y);
      }
    }
    polygon.role.covers = random() % 4 != 0;
    polygon.slack = uniform(random, 0.0, 0.01);
    polygon.noise = uniform(random, 0.0, 0.1);
    return polygon;
  };
  for (int i = 0; i < 200; ++i)
  {
    shapes.triangles.push_back(anyPolygon());
    if (i % 8 == 0) // the same layer again
    {
      shapes.triangles.push_back(shapes.triangles.back());
    }
  }
  for (int i = 0; i < 4; ++i)
  {
    MapPolygon polygon = anyPolygon();
    polygon.facing = 0;
    polygon.role = { true, false, true };
    polygon.margin = uniform(random, 0.0, 3.0);
    shapes.spoiling.push_back(polygon);
  }
  for (int i = 0; i < 100; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    MapSegment segment = segmentBetween(
      corners[0], i % 10 == 0 ? glm::dvec3(corners[0].x, corners[1].y, 0.5) : corners[1]);
    segment.slack = i % 10 == 1 ? infinity : 0.01;
    segment.isEnd = random() % 2 == 0;
    shapes.segments.push_back(segment);
  }
  for (int i = 0; i < 60; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    MapRing ring;
    ring.triangles.push_back(polygonWith(corners));
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec3 &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
      const glm::dvec3 other = a + b - c;
      if (i % 4 == 0)
      {
        ring.border.push_back(segmentBetween(a, b));
        continue;
      }
      ring.triangles.push_back(polygonWith({ { b, a, other } }));
      ring.border.push_back(segmentBetween(a, other));
      ring.border.push_back(segmentBetween(other, b));
    }
    shapes.rings.push_back(ring);
  }
  return shapes;
}

TEST(TexelCells, ofSomeRowsAreThoseOfTheWholeMap)
{
  Random random(41);
  std::size_t filled = 0;
  for (int picture = 0; picture < 200; ++picture)
  {
    const int width = 1 + static_cast<int>(random() % 200);
    const int first = static_cast<int>(random() % static_cast<unsigned int>(width));
    const Span rows{ first,
      first + static_cast<int>(random() % static_cast<unsigned int>(width - first)) };
    const Shapes shapes = randomShapes(random, width);
    filled += expectSame(shapes.drawn(width, rows), shapes.drawn(width, { 0, width - 1 }), width,
      "picture " + std::to_string(picture),
      static_cast<std::size_t>(first) * static_cast<std::size_t>(width));
  }
  EXPECT_GT(filled, 150000u);
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
  Shapes shapes;
  shapes.margin = casters.margin();
  casters.placements().visitAll([&](const Placement& placement)
    { return casters.edgeCount(placement); },
    [&](std::uint32_t placement, std::uint32_t i)
    {
      MapSegment found;
      if (casters.segment({ placement, i }, found))
      {
        const std::lock_guard<std::mutex> lock(mutex);
        shapes.segments.push_back(found);
      }
    });
  for (const BandItem& triangle : triangles)
  {
    const MapPolygon polygon = casters.polygon(triangle);
    if (polygon.role.poison)
    {
      shapes.spoiling.push_back(polygon);
    }
    if (polygon.facing != 0)
    {
      shapes.triangles.push_back(polygon);
    }
    if (covering != Covering::Triangle && polygon.role.covers)
    {
      shapes.rings.push_back(casters.ring(triangle, polygon));
    }
  }
  return shapes.drawn(size, { 0, size - 1 });
}

/// Return the cells of a whole map; none if a caster is at the light.
std::vector<Cell> drawnInBands(
  const CasterScene& scene, const CasterEdges& edges, int size, Covering covering)
{
  std::vector<Cell> cells(countOf(size, { 0, size - 1 }));
  return drawCellsOnCpu(
           scene, edges, size, covering, [&](std::size_t i, const Cell& cell) { cells[i] = cell; })
    ? cells
    : std::vector<Cell>();
}

class RandomCells : public testing::TestWithParam<const char*>
{
};

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
      EXPECT_EQ(cells.size(), expected.size()) << picture.description;
      filled += expectSame(cells, expected, size, picture.description);
    }
  }
  EXPECT_GT(filled, 10000u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomCells, testing::ValuesIn(randomSceneNames()),
  [](const testing::TestParamInfo<const char*>& scene) { return lettersOf(scene.param); });

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
  ASSERT_EQ(cells.size(), countOf(size, { 0, size - 1 }));
  expectSame(
    cells, drawnOneByOne(scene, edges, size, Covering::Triangle), size, picture.description);
  EXPECT_TRUE(
    std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.noise > 0.0f; }));
}

} // namespace
} // namespace gnomon::test
