// Conservative maps baked on the GPU. Their cells equal the CPU's, bit for bit, for all shapes, and
// agree with separating axes at each texel.

#include "shadowtech/exact/CellsOnGpu.h"

#include "../plugin/LiveObjects.h"
#include "RandomScenes.h"
#include "TexelPolygons.h"

#include "shadowtech/exact/CellsOnCpu.h"

#include "vtkGnomonEGLRenderWindow.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon::test
{
namespace
{

/// True if all used values are equal. The values of a texel whose depths a triangle spoils are not
/// used.
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
std::size_t expectSame(
  const std::vector<Cell>& gpu, const std::vector<Cell>& cpu, int width, const std::string& what)
{
  EXPECT_EQ(gpu.size(), cpu.size());
  std::size_t different = 0, filled = 0;
  for (std::size_t i = 0; i < std::min(gpu.size(), cpu.size()); ++i)
  {
    filled += cpu[i].nearest < infinity ? 1 : 0;
    if (!areSame(gpu[i], cpu[i]) && ++different == 1)
    {
      ADD_FAILURE() << what << ": texel " << i % static_cast<std::size_t>(width) << ", "
                    << i / static_cast<std::size_t>(width) << ": " << textOf(gpu[i])
                    << "; by the CPU: " << textOf(cpu[i]);
    }
  }
  EXPECT_EQ(different, 0u) << what << ", of " << filled;
  return filled;
}

class CellsDrawnOnGpu : public testing::Test
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
    ASSERT_EQ(CellTarget::whyUnsupported(), "");
  }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

  vtkNew<vtkGnomonEGLRenderWindow> window_;
  ShaderLibrary shaders_;
};

/// Random shapes, drawn by the CPU and the GPU.
struct Shapes
{
  std::vector<MapSegment> segments;
  std::vector<MapPolygon> spoiling, triangles;
  std::vector<MapRing> rings;
  double margin = marginTexels;

  std::vector<Cell> onCpu(int width, Span rows) const
  {
    std::vector<Cell> cells(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.last - rows.first + 1));
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

  std::vector<Cell> onGpu(ShaderLibrary& shaders, int width, Span rows) const
  {
    SegmentBatch segmentBatch;
    for (const MapSegment& segment : this->segments)
    {
      segmentBatch.add(SegmentOnTexels(segment, this->margin, rows));
    }
    TriangleBatch spoilingBatch, triangleBatch;
    for (const MapPolygon& polygon : this->spoiling)
    {
      spoilingBatch.add(polygon, this->margin, width, rows);
    }
    for (const MapPolygon& polygon : this->triangles)
    {
      triangleBatch.add(polygon, this->margin, width, rows);
    }
    RingBatch ringBatch;
    for (const MapRing& ring : this->rings)
    {
      ringBatch.add(ring, this->margin, rows);
    }
    CellTarget target(shaders, width, rows);
    target.draw(segmentBatch);
    target.spoil(spoilingBatch);
    target.endPass();
    target.draw(triangleBatch);
    target.draw(ringBatch);
    target.endPass();
    target.drawNoise(triangleBatch);
    std::vector<Cell> cells(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(rows.last - rows.first + 1));
    target.read([&](std::size_t i, const Cell& cell) { cells[i] = cell; });
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

TEST_F(CellsDrawnOnGpu, areThoseOfTheCpu)
{
  Random random(41);
  std::size_t filled = 0;
  for (int picture = 0; picture < 40; ++picture)
  {
    const int width = 1 + static_cast<int>(random() % 200);
    const int first = static_cast<int>(random() % static_cast<unsigned int>(width));
    const Span rows = picture % 2
      ? Span{ first, first + static_cast<int>(random() % static_cast<unsigned int>(width - first)) }
      : Span{ 0, width - 1 };
    const Shapes shapes = randomShapes(random, width);
    filled += expectSame(shapes.onGpu(this->shaders_, width, rows), shapes.onCpu(width, rows),
      width, "picture " + std::to_string(picture));
  }
  EXPECT_GT(filled, 100000u);
}

/// Return one map's cells; none if a caster is at the light.
template <typename Draw>
std::vector<Cell> drawnBy(int size, const Draw& draw)
{
  std::vector<Cell> cells(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  return draw([&](std::size_t i, const Cell& cell) { cells[i] = cell; }) ? cells
                                                                         : std::vector<Cell>();
}

class RandomCellsOnGpu
  : public CellsDrawnOnGpu
  , public testing::WithParamInterface<const char*>
{
};

TEST_P(RandomCellsOnGpu, areThoseOfTheCpu)
{
  std::size_t filled = 0;
  const CellsOnGpu atOnce(this->shaders_);
  const CellsOnGpu inParts(this->shaders_, { 100000, 2000 });
  for (unsigned int seed = 1; seed <= 6; ++seed)
  {
    const RandomPicture picture = makeRandomPicture(GetParam(), seed);
    CasterEdges edges;
    edges.update(picture.occluders);
    const int size = picture.light.mapSizeTexels;
    const auto covering = static_cast<Covering>(seed % 3);
    const CellsOnGpu& gpu = seed % 2 ? atOnce : inParts;
    for (const LightView& view : picture.views.views)
    {
      const CasterScene scene =
        casterScene(view, picture.views.box.z > 0.0, size, picture.occluders);
      filled += expectSame(
        drawnBy(
          size, [&](const TakeCell& take) { return gpu.draw(scene, edges, size, covering, take); }),
        drawnBy(size,
          [&](const TakeCell& take) { return drawCellsOnCpu(scene, edges, size, covering, take); }),
        size, picture.description);
    }
  }
  EXPECT_GT(filled, 10000u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RandomCellsOnGpu, testing::ValuesIn(randomSceneNames()),
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

/// The CPU stores a limited number of a band's triangles for their noise, and visits the others
/// again.
TEST_F(CellsDrawnOnGpu, areThoseOfTheCpuWhereManyTrianglesLieInABand)
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
  const CellsOnGpu gpu(this->shaders_);
  const std::vector<Cell> cells = drawnBy(size,
    [&](const TakeCell& take)
    { return drawCellsOnCpu(scene, edges, size, Covering::Triangle, take); });
  expectSame(
    drawnBy(size,
      [&](const TakeCell& take) { return gpu.draw(scene, edges, size, Covering::Triangle, take); }),
    cells, size, picture.description);
  EXPECT_TRUE(
    std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.noise > 0.0f; }));
}

TEST_F(CellsDrawnOnGpu, leaveNothingBehindAndOpenGlAsItWas)
{
  Random random(43);
  const Shapes shapes = randomShapes(random, 64);
  shapes.onGpu(this->shaders_, 64, { 0, 63 }); // programs stay compiled
  const LiveObjects before = countLiveObjects(this->window_);
  GlBuffer mine;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, mine.create());
  for (int i = 0; i < 3; ++i)
  {
    shapes.onGpu(this->shaders_, 64, { 0, 63 });
  }
  GLint bound = 0, program = -1;
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 3, &bound);
  EXPECT_EQ(static_cast<GLuint>(bound), mine.name());
  glGetIntegerv(GL_CURRENT_PROGRAM, &program);
  EXPECT_EQ(program, 0);
  mine.reset();
  EXPECT_EQ(countLiveObjects(this->window_), before);
}

TEST_F(CellsDrawnOnGpu, areEmptyWithoutCasters)
{
  for (const Cell& cell : Shapes().onGpu(this->shaders_, 7, { 2, 5 }))
  {
    EXPECT_TRUE(areSame(cell, Cell()));
  }
}

TEST_F(CellsDrawnOnGpu, needRoom)
{
  const std::size_t room = CellsOnGpu::Room().cells;
  GLint64 block = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  if (static_cast<std::size_t>(block) >= room)
  {
    EXPECT_GE(CellTarget::mostRows(2048, room), 2048);
  }
  EXPECT_EQ(CellTarget::mostRows(100, 2 * 28 * 100 + 1), 2);
  EXPECT_EQ(CellTarget::mostRows(100, 1), 1);
}

/// Return the error that is thrown if OpenGL fails; empty if none is.
template <typename Call>
std::string failureOf(const Call& call)
{
  try
  {
    call();
    return {};
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
}

TEST_F(CellsDrawnOnGpu, areNotThereWhereOpenGlFails)
{
  TriangleBatch batch;
  batch.add(polygonWith({ { { 1.0, 1.0, 0.5 }, { 6.0, 1.0, 0.5 }, { 1.0, 6.0, 0.5 } } }),
    marginTexels, 8, { 0, 7 });
  const auto nothing = [](std::size_t, const Cell&) {};
  {
    CellTarget target(this->shaders_, 8, { 0, 7 });
    target.draw(batch);
    // Cells that are mapped for the CPU cannot be read.
    GLint cells = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 3, &cells);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(cells));
    ASSERT_NE(glMapBuffer(GL_SHADER_STORAGE_BUFFER, GL_READ_ONLY), nullptr);
    EXPECT_EQ(failureOf([&] { target.read(nothing); }),
      "a conservative map of 8 texels could not be baked on the GPU: OpenGL reports error 0x502");
    glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    EXPECT_EQ(failureOf([&] { target.read(nothing); }), "");
  }
}

TEST_F(CellsDrawnOnGpu, areNotDrawnBySilhouettes)
{
  const RandomPicture picture = makeRandomPicture(randomSceneNames().front(), 1);
  CasterEdges edges;
  edges.update(picture.occluders);
  const CasterScene scene =
    casterScene(picture.views.views.front(), picture.views.box.z > 0.0, 16, picture.occluders);
  EXPECT_THROW(CellsOnGpu(this->shaders_)
                 .draw(scene, edges, 16, Covering::Silhouette, [](std::size_t, const Cell&) {}),
    std::logic_error);
}

TEST(CellBatches, areAsManyAsOneBufferOfEachHolds)
{
  constexpr std::size_t mostBytes = 4000, rings = 500;
  Random random(45);
  CollectedBatches<RingBatch> batches(mostBytes);
  std::size_t largestRing = 0;
  for (std::size_t i = 0; i < rings; ++i)
  {
    // A fan, like that of a vertex with up to 20 triangles.
    MapRing ring;
    for (unsigned int k = 0; k <= random() % 20; ++k)
    {
      ring.triangles.push_back(polygonWith(randomTriangle(random, 64)));
    }
    RingBatch alone;
    alone.add(ring, marginTexels, { 0, 63 });
    largestRing = std::max(largestRing, alone.largestBytes());
    batches.local().add(ring, marginTexels, { 0, 63 });
  }
  std::size_t drawn = 0, count = 0;
  batches.drawAll(
    [&](const RingBatch& batch)
    {
      ++count;
      drawn += batch.records.size();
      EXPECT_LT(batch.polygons.records.size() * sizeof(PolygonRecord), mostBytes + largestRing);
      EXPECT_LT(batch.polygons.sides.size() * sizeof(SideRecord), mostBytes + largestRing);
    });
  EXPECT_EQ(drawn, rings);
  EXPECT_GT(count, 10u);
  batches.drawAll([](const RingBatch&) { FAIL() << "they were handed over"; });
}

} // namespace
} // namespace gnomon::test
