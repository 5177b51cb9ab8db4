// The rasteriser of conservative maps, against each pair of cell and triangle: the texels that a
// triangle meets and contains, and its depths there.

#include "shadowtech/exact/TexelCells.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include "shadowtech/exact/CellsOnCpu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

constexpr int cellsWidth = 32;

/// The margin, minus more than rounding.
constexpr double margin = 0.999 * marginTexels;

// For all drawn shapes.
constexpr double sheetSlack = 0.01;
constexpr double sheetNoise = 0.02;

constexpr Span allRows{ 0, cellsWidth - 1 };

/// Draw polygons, with the noise of those that do not lie along the light.
std::vector<Cell> drawn(const std::vector<MapPolygon>& polygons)
{
  std::vector<Cell> cells(cellsWidth * cellsWidth);
  for (const MapPolygon& polygon : polygons)
  {
    drawPolygon(
      polygon, PolygonOnTexels(polygon, marginTexels, allRows), cellsWidth, allRows, cells.data());
  }
  for (const MapPolygon& polygon : polygons)
  {
    if (polygon.facing != 0)
    {
      drawNoise(PolygonOnTexels(polygon, marginTexels, allRows), cellsWidth, allRows, cells.data());
    }
  }
  return cells;
}

std::vector<Cell> drawn(const Corners& corners)
{
  MapPolygon polygon = polygonWith(corners);
  polygon.slack = sheetSlack;
  polygon.noise = sheetNoise;
  return drawn({ polygon });
}

/// @param visit called with the lower corner and the number of each cell around a triangle
template <typename Visit>
void visitCells(const Corners& corners, const Visit& visit)
{
  glm::dvec2 least(infinity), most(-infinity);
  for (const glm::dvec3& corner : corners)
  {
    least = glm::min(least, glm::dvec2(corner));
    most = glm::max(most, glm::dvec2(corner));
  }
  const glm::ivec2 first(glm::max(glm::floor(least) - 2.0, 0.0));
  const glm::ivec2 last(glm::min(glm::floor(most) + 2.0, cellsWidth - 1.0));
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      visit(glm::dvec2(x, y), static_cast<std::size_t>(y * cellsWidth + x));
    }
  }
}

TEST(TexelCells, areThoseThatATriangleMeetsAndContainsAndHardlyMore)
{
  /// The number of true cells, and the rasteriser's errors.
  struct Said
  {
    std::size_t truly = 0, missing = 0, extra = 0;

    void add(bool truth, bool said)
    {
      this->truly += truth ? 1 : 0;
      this->missing += truth && !said ? 1 : 0;
      this->extra += said && !truth ? 1 : 0;
    }
  };
  Said meets, contained;
  Random random(11);
  for (int i = 0; i < 100000; ++i)
  {
    const Corners corners = randomTriangle(random, cellsWidth);
    const std::vector<Cell> cells = drawn(corners);
    visitCells(corners,
      [&](const glm::dvec2& low, std::size_t at)
      {
        const glm::dvec2 from = low - margin, to = low + 1.0 + margin;
        meets.add(overlap(corners, from, to), std::isfinite(cells[at].nearest));
        contained.add(contains(corners, from, to), std::isfinite(cells[at].contained));
      });
  }
  EXPECT_EQ(meets.missing, 0u);
  EXPECT_GT(meets.truly, 1000000u);
  EXPECT_LT(static_cast<double>(meets.extra), 3e-5 * static_cast<double>(meets.truly));
  EXPECT_EQ(contained.extra, 0u);
  EXPECT_GT(contained.truly, 300000u);
  EXPECT_LT(static_cast<double>(contained.missing), 1e-5 * static_cast<double>(contained.truly));
}

TEST(TexelCells, boundTheDepthsThatATriangleHasInThem)
{
  std::size_t samples = 0, layers = 0;
  Random random(11);
  for (int i = 0; i < 20000; ++i)
  {
    const Corners corners = randomTriangle(random, cellsWidth);
    const std::vector<Cell> cells = drawn(corners);
    const auto depthAt = depthOf(corners);
    const auto [least, most] = std::minmax({ corners[0].z, corners[1].z, corners[2].z });
    const glm::dvec2 perTexel(
      depthAt({ 1.0, 0.0 }) - depthAt({ 0.0, 0.0 }), depthAt({ 0.0, 1.0 }) - depthAt({ 0.0, 0.0 }));
    const double half = (std::abs(perTexel.x) + std::abs(perTexel.y)) * (0.5 + marginTexels);
    visitCells(corners,
      [&, least = least, most = most](const glm::dvec2& low, std::size_t at)
      {
        const Cell& cell = cells[at];
        if (!std::isfinite(cell.nearest))
        {
          return;
        }
        const double middle = depthAt(low + 0.5);
        // The rounding of depths of this size in float.
        const double rounding = 1e-6 * (1.0 + std::abs(middle));
        for (int sample = 0; sample < 64; ++sample)
        {
          const glm::dvec2 place = glm::dvec2(sample % 8, sample / 8) / 7.0;
          const glm::dvec2 point = low - margin + (1.0 + 2.0 * margin) * place;
          if (isInside(corners, point))
          {
            ++samples;
            EXPECT_LE(cell.nearest, depthAt(point) - sheetSlack + rounding);
            EXPECT_GE(cell.partAcross, depthAt(point) + sheetSlack - rounding);
            if (std::isfinite(cell.first))
            {
              ++layers;
              EXPECT_GE(cell.climb, cell.first - depthAt(point) + sheetSlack - rounding);
            }
          }
        }
        // Cells' depths are no wider than the triangle, and than its plane in the texel.
        EXPECT_GE(cell.nearest, std::max(least, middle - half) - sheetSlack - rounding);
        EXPECT_LE(cell.partAcross, std::min(most, middle + half) + sheetSlack + rounding);
        EXPECT_EQ(cell.noise, static_cast<float>(sheetNoise));
        EXPECT_TRUE(!std::isfinite(cell.contained) || cell.contained == cell.partAcross);
      });
  }
  EXPECT_GT(samples, 1000000u);
  EXPECT_GT(layers, 100000u);
}

/// The offset of rays depends on the shapes that may come before the map's receivers, not on those
/// behind its only layer.
TEST(TexelCells, haveTheNoiseOfWhatBeginsBeforeTheLastReceiver)
{
  constexpr std::size_t middle = 6 * cellsWidth + 6;
  /// A triangle with its corner at x = y = `from` and sides of length `side`. `depth` is at the
  /// texel's middle.
  struct Sheet
  {
    double depth, perTexel, noise;
    double from = 1.0, side = 24.0;
  };
  const auto noiseOf = [](const std::vector<Sheet>& sheets)
  {
    std::vector<MapPolygon> polygons;
    for (const auto& [depth, perTexel, noise, from, side] : sheets)
    {
      const double near = depth + perTexel * (from - 6.5), to = from + side;
      polygons.push_back(polygonWith(
        { { { from, from, near }, { to, from, near + perTexel * side }, { from, to, near } } }));
      polygons.back().noise = noise;
    }
    std::vector<float> noises;
    // In any order of drawing.
    const auto isLess = [](const MapPolygon& a, const MapPolygon& b) { return a.noise < b.noise; };
    std::sort(polygons.begin(), polygons.end(), isLess);
    do
    {
      noises.push_back(drawn(polygons)[middle].noise);
    } while (std::next_permutation(polygons.begin(), polygons.end(), isLess));
    EXPECT_EQ(std::count(noises.begin(), noises.end(), noises.front()), 6);
    return noises.front();
  };
  EXPECT_EQ(noiseOf({ { 0.2, 0.0, 0.01 }, { 0.5, 0.0, 0.02 }, { 0.7, 0.0, 0.03 } }), 0.01f);
  EXPECT_EQ(noiseOf({ { 0.2, 0.1, 0.01 }, { 0.5, 0.1, 0.02 }, { 0.7, 0.2, 0.03 } }), 0.01f)
    << "each climbs, and begins behind the last receiver";
  EXPECT_EQ(noiseOf({ { 0.2, 0.0, 0.01 }, { 0.4, 0.2, 0.02 }, { 0.7, 0.0, 0.03 } }), 0.01f)
    << "the second begins before its depth at the sample, but it climbs as far";
  // A shape that does not reach the sample is no layer.
  const Sheet sheet{ 0.2, 0.0, 0.01 }, behind{ 0.5, 0.0, 0.02 };
  EXPECT_EQ(noiseOf({ sheet, behind, { 0.3, 0.0, 0.03, 6.1, 0.2 } }), 0.03f);
  EXPECT_EQ(noiseOf({ sheet, behind, { 0.6, 0.0, 0.03, 6.1, 0.2 } }), 0.01f);
}

TEST(TexelCells, ofATriangleAlongTheLightAreNoneOrSpoiltWithinItsMargin)
{
  Random random(14);
  std::size_t spoilt = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const Corners corners = randomTriangle(random, cellsWidth);
    MapPolygon polygon = polygonWith(corners);
    polygon.facing = 0;
    polygon.role.covers = false;
    const std::vector<Cell> none = drawn({ polygon });
    EXPECT_TRUE(std::none_of(
      none.begin(), none.end(), [](const Cell& cell) { return std::isfinite(cell.nearest); }));
    polygon.role = { true, false, true };
    polygon.margin = 0.7;
    const std::vector<Cell> cells = drawn({ polygon });
    visitCells(corners,
      [&](const glm::dvec2& low, std::size_t at)
      {
        if (overlap(corners, low - 0.699, low + 1.699))
        {
          ++spoilt;
          EXPECT_EQ(cells[at].nearest, -infinity);
          EXPECT_EQ(cells[at].partEnd, -infinity);
          EXPECT_EQ(cells[at].sharpEnd, -infinity);
        }
      });
  }
  EXPECT_GT(spoilt, 10000u);
}

TEST(TexelCells, ofAnEdgeHaveItsLeastDepth)
{
  Random random(15);
  std::size_t points = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Corners corners = randomTriangle(random, cellsWidth);
    const glm::dvec3 &from = corners[0], &to = corners[1];
    MapSegment segment;
    segment.ends = { { { from.x, from.y, from.z }, { to.x, to.y, to.z } } };
    segment.slack = sheetSlack;
    segment.isEnd = i % 2 == 0;
    std::vector<Cell> cells(cellsWidth * cellsWidth);
    drawSegment(segment, marginTexels, cellsWidth, allRows, cells.data());
    drawEndOfPart(segment, marginTexels, cellsWidth, allRows, cells.data());
    // Near the segment, too.
    const double near = margin + thinTexels;
    for (int k = 0; k < 64; ++k)
    {
      const glm::dvec3 at = from + k / 63.0 * (to - from);
      const glm::dvec2 point =
        glm::dvec2(at) + near * glm::dvec2((k & 1) ? 1.0 : -1.0, (k & 2) ? 1.0 : -1.0);
      if (point.x >= 0.0 && point.y >= 0.0 && point.x < cellsWidth && point.y < cellsWidth)
      {
        ++points;
        const Cell& cell = cells[static_cast<std::size_t>(
          static_cast<int>(point.y) * cellsWidth + static_cast<int>(point.x))];
        EXPECT_LE(cell.sharpEnd, at.z - sheetSlack + 1e-6);
        EXPECT_EQ(cell.nearest, segment.isEnd ? cell.sharpEnd : infinity);
        EXPECT_EQ(cell.partEnd, cell.sharpEnd);
      }
    }
    const Corners line{ { from, to, to } };
    visitCells(line,
      [&](const glm::dvec2& low, std::size_t at)
      {
        const double far = 1.01 * (marginTexels + thinTexels);
        const float depth = cells[at].sharpEnd;
        EXPECT_TRUE(depth == infinity || overlap(line, low - far, low + 1.0 + far));
        EXPECT_GE(depth, std::min(from.z, to.z) - sheetSlack - 1e-6);
      });
  }
  EXPECT_GT(points, 100000u);
}

TEST(TexelCells, areCoveredByAPartThatDoesNotEndThereWhateverOthersDo)
{
  // A square of two triangles at depth 0.5, and an edge before or behind it, of its own part or of
  // another part.
  const Corners halves[] = { { { { 2.0, 2.0, 0.5 }, { 9.0, 2.0, 0.5 }, { 9.0, 9.0, 0.5 } } },
    { { { 2.0, 2.0, 0.5 }, { 9.0, 9.0, 0.5 }, { 2.0, 9.0, 0.5 } } } };
  constexpr std::size_t onDiagonal = 5 * cellsWidth + 5;
  const auto coveredFrom = [&](CasterPart square, CasterPart edge, double depthOfEdge)
  {
    std::vector<Cell> cells(cellsWidth * cellsWidth);
    MapSegment end;
    end.ends = { { { 5.2, 5.0, depthOfEdge }, { 5.3, 6.0, depthOfEdge } } };
    end.isEnd = true;
    end.part = edge;
    drawEndOfPart(end, marginTexels, cellsWidth, allRows, cells.data());
    for (const Corners& half : halves)
    {
      MapPolygon polygon = polygonWith(half);
      polygon.part = square;
      polygon.slack = sheetSlack;
      drawPolygon(polygon, PolygonOnTexels(polygon, marginTexels, allRows), cellsWidth, allRows,
        cells.data());
    }
    Cell cell = cells[onDiagonal];
    EXPECT_EQ(cell.contained, infinity);
    cell.turnTo(noPart);
    return cell.covered;
  };
  const auto from = static_cast<float>(0.5 + 3.0 * sheetSlack);
  EXPECT_NEAR(coveredFrom(1, 1, 0.9), from, 1e-5f) << "what lies behind does not matter";
  EXPECT_NEAR(coveredFrom(1, 2, 0.3), from, 1e-5f) << "nor does another part's end";
  EXPECT_EQ(coveredFrom(1, 1, 0.3), infinity);
  EXPECT_EQ(coveredFrom(1, 1, 0.5), infinity);
}

// Cells of conservative maps, baked in bands of rows on all cores, against all shapes drawn one
// after another.

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
