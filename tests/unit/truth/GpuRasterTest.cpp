// Conservative rasterisation on the GPU against cells and triangles compared one by one, in double precision.

#include "GpuRaster.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include "shadowtech/conservative/TexelCells.h"

#include "vtkGnomonEGLRenderWindow.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Texels in x and y, from the first to the last.
struct TexelBox
{
  glm::ivec2 first, last;

  template <typename Visit>
  void visit(const Visit& visitTexel) const
  {
    for (int y = this->first.y; y <= this->last.y; ++y)
    {
      for (int x = this->first.x; x <= this->last.x; ++x)
      {
        visitTexel(glm::ivec2(x, y));
      }
    }
  }
};

/// The texels of a map around a triangle.
TexelBox boxAround(const Corners& corners, int size)
{
  glm::dvec2 least(infinity), most(-infinity);
  for (const glm::dvec3& corner : corners)
  {
    least = glm::min(least, glm::dvec2(corner));
    most = glm::max(most, glm::dvec2(corner));
  }
  const glm::dvec2 limit(size);
  return { glm::ivec2(glm::clamp(glm::floor(least) - 2.0, glm::dvec2(0.0), limit)),
    glm::ivec2(glm::clamp(glm::floor(most) + 2.0, glm::dvec2(-1.0), limit - 1.0)) };
}

/// The least and the greatest depth of a triangle in a cell, by cutting; the greatest is less where
/// rounding leaves nothing.
std::pair<double, double> depthsIn(const Corners& corners, const glm::dvec2& low)
{
  std::vector<glm::dvec3> polygon(corners.begin(), corners.end());
  for (int side = 0; side < 4; ++side)
  {
    const int axis = side / 2;
    const double sign = side % 2 ? -1.0 : 1.0;
    const double limit = low[axis] + side % 2;
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const glm::dvec3& a = polygon[i];
      const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
      const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
      if (da >= 0.0)
      {
        kept.push_back(a);
      }
      if ((da >= 0.0) != (db >= 0.0))
      {
        kept.push_back(a + da / (da - db) * (b - a));
      }
    }
    polygon = kept;
  }
  std::pair<double, double> depths(infinity, -infinity);
  for (const glm::dvec3& corner : polygon)
  {
    depths = { std::min(depths.first, corner.z), std::max(depths.second, corner.z) };
  }
  return depths;
}

/// A triangle's corners on the map, exactly enough.
Corners onMap(const glm::dmat4& mapFromCentred, const std::array<glm::vec3, 3>& positions)
{
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec4 map = mapFromCentred * glm::dvec4(positions[k], 1.0);
    corners[k] = glm::dvec3(map) / map.w;
  }
  return corners;
}

/// What is drawn: triangles in the places that a matrix takes to the map.
class Triangles
{
public:
  explicit Triangles(const glm::dmat4& mapFromCentred = glm::dmat4(1.0))
    : mapFromCentred_(mapFromCentred)
    , centredFromMap_(glm::inverse(mapFromCentred))
  {
  }

  /// @param corners on the map, to within what the positions' rounding moves them by
  void add(const Corners& corners)
  {
    std::array<glm::vec3, 3> positions;
    const auto first = static_cast<unsigned int>(this->positions_.size());
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec4 centred = this->centredFromMap_ * glm::dvec4(corners[k], 1.0);
      positions[k] = glm::vec3(glm::dvec3(centred) / centred.w);
      this->positions_.push_back(positions[k]);
    }
    this->triangles_.push_back({ first, first + 1, first + 2 });
    this->corners_.push_back(onMap(this->mapFromCentred_, positions));
  }

  /// @param margin that is asked for beside what rounding takes
  std::vector<TexelDepths> draw(GpuRaster& raster, int size, double margin) const
  {
    std::vector<TexelDepths> texels;
    raster.send(this->positions_, this->triangles_);
    raster.draw(this->mapFromCentred_, size, margin, texels);
    return texels;
  }

  /// On the map.
  const std::vector<Corners>& corners() const { return this->corners_; }

private:
  glm::dmat4 mapFromCentred_, centredFromMap_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::uvec3> triangles_;
  std::vector<Corners> corners_;
};

/// What float leaves of a depth, beside bounds that are computed in double.
double roundingOf(const Corners& corners)
{
  return 1e-12 * (1.0 + std::abs(corners[0].z) + std::abs(corners[1].z) + std::abs(corners[2].z));
}

/// How often something was as it should be.
struct Counts
{
  std::size_t touched = 0, missing = 0, extra = 0;
  std::size_t contained = 0, lost = 0, invented = 0;
  std::size_t nearer = 0, farther = 0; ///< depths beyond what was drawn as a bound
  std::size_t finite = 0;

  /// @param drawn where no other triangle is
  void add(const Corners& corners, const glm::ivec2& texel, const TexelDepths& drawn)
  {
    const glm::dvec2 low(texel);
    const bool isTouched = overlap(corners, low, low + 1.0);
    const bool isContained = gnomon::test::contains(corners, low, low + 1.0);
    const bool isDrawn = drawn.nearest < std::numeric_limits<float>::infinity();
    const bool isCovered = drawn.contained < std::numeric_limits<float>::infinity();
    this->touched += isTouched ? 1 : 0;
    this->missing += isTouched && !isDrawn ? 1 : 0;
    this->extra += isDrawn && !isTouched ? 1 : 0;
    this->contained += isContained ? 1 : 0;
    this->lost += isContained && !isCovered ? 1 : 0;
    this->invented += isCovered && !isContained ? 1 : 0;
    this->finite += isDrawn ? 1 : 0;
    if (isTouched)
    {
      const auto [least, most] = depthsIn(corners, low);
      const double rounding = roundingOf(corners);
      this->nearer += least < drawn.nearest - rounding ? 1 : 0;
      this->farther += isCovered && most > drawn.contained + rounding ? 1 : 0;
    }
  }

  /// The same of all texels of a map.
  void add(const Corners& corners, int size, const std::vector<TexelDepths>& drawn)
  {
    TexelBox{ glm::ivec2(0), glm::ivec2(size - 1) }.visit([&](const glm::ivec2& texel)
      { this->add(corners, texel, drawn[static_cast<std::size_t>(texel.y * size + texel.x)]); });
  }

  void expectSound() const
  {
    EXPECT_EQ(this->missing, 0u) << "of " << this->touched;
    EXPECT_EQ(this->invented, 0u) << "of " << this->contained;
    EXPECT_EQ(this->nearer, 0u);
    EXPECT_EQ(this->farther, 0u);
  }
};

class GpuRasterTest : public testing::TestWithParam<RasterPath>
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
    const std::string why = whyUnsupported(GetParam());
    if (!why.empty())
    {
      GTEST_SKIP() << why;
    }
  }
  vtkNew<vtkGnomonEGLRenderWindow> window_;
};

INSTANTIATE_TEST_SUITE_P(Paths, GpuRasterTest, testing::ValuesIn(allRasterPaths()),
  [](const testing::TestParamInfo<RasterPath>& path) { return std::string(nameOf(path.param)); });

/// Matrices to maps of this size: none at all, one with depths that float cannot tell well, a turned view along
/// parallel rays, and one from a position.
std::vector<glm::dmat4> matricesFor(int size)
{
  const double half = 0.5 * size;
  const glm::dmat4 texels =
    glm::scale(glm::translate(glm::dmat4(1.0), { half, half, 0.5 }), { half, half, 0.5 });
  const glm::dmat4 view =
    glm::lookAt(glm::dvec3(3.0, -4.0, 5.0), { 0.2, 0.3, -0.1 }, { 0.0, 0.0, 1.0 });
  const double third = 1.0 / 3.0;
  const glm::dmat4 deep =
    glm::scale(glm::translate(glm::dmat4(1.0), { 0.0, 0.0, 1e4 * third }), { 1.0, 1.0, third });
  return { glm::dmat4(1.0), deep, texels * glm::ortho(-2.0, 2.0, -2.0, 2.0, 1.0, 12.0) * view,
    texels * glm::perspective(0.9, 1.0, 1.0, 12.0) * view };
}

TEST_P(GpuRasterTest, drawsAllTexelsThatTrianglesTouchAndNoneThatTheyDoNotContain)
{
  constexpr int size = 1024, tile = 64;
  GpuRaster raster(GetParam());
  Random random(31);
  Counts counts;
  std::size_t finite = 0;
  for (const glm::dmat4& matrix : matricesFor(size))
  {
    for (int picture = 0; picture < 98; ++picture)
    {
      Triangles triangles(matrix);
      for (int y = tile / 2; y < size; y += tile)
      {
        for (int x = tile / 2; x < size; x += tile)
        {
          Corners corners = randomTriangle(random, 0);
          const glm::dvec3 place(
            x + uniform(random, -1.0, 1.0), y + uniform(random, -1.0, 1.0), 0.0);
          for (glm::dvec3& corner : corners)
          {
            corner = place + corner * glm::dvec3(0.65, 0.65, 1.0);
          }
          triangles.add(corners);
        }
      }
      const std::vector<TexelDepths> texels =
        triangles.draw(raster, size, picture % 2 ? marginTexels : 0.0);
      for (const Corners& corners : triangles.corners())
      {
        boxAround(corners, size)
          .visit(
            [&](const glm::ivec2& texel) {
              counts.add(
                corners, texel, texels[static_cast<std::size_t>(texel.y * size + texel.x)]);
            });
      }
      finite += static_cast<std::size_t>(std::count_if(texels.begin(), texels.end(),
        [](const TexelDepths& texel)
        { return texel.nearest < std::numeric_limits<float>::infinity(); }));
    }
  }
  counts.expectSound();
  EXPECT_EQ(finite, counts.finite) << "texels that are near to no triangle";
  EXPECT_GT(counts.touched, 1000000u);
  EXPECT_LT(static_cast<double>(counts.extra), 0.03 * static_cast<double>(counts.touched));
  EXPECT_LT(static_cast<double>(counts.lost), 0.02 * static_cast<double>(counts.contained));
  RecordProperty(
    "extraPercent", std::to_string(100.0 * static_cast<double>(counts.extra) / counts.touched));
  RecordProperty(
    "lostPercent", std::to_string(100.0 * static_cast<double>(counts.lost) / counts.contained));
}

TEST_P(GpuRasterTest, drawsTexelsThatATriangleTouchesInACorner)
{
  // Corners and sides lie on texels' corners and sides: all of it is exact in double.
  GpuRaster raster(GetParam());
  Random random(32);
  Counts counts;
  for (int i = 0; i < 300; ++i)
  {
    const int size = 17 + static_cast<int>(random() % 16);
    const double step = i % 3 == 0 ? 1.0 : 0.25;
    Corners corners;
    for (glm::dvec3& corner : corners)
    {
      const auto place = [&] { return step * std::floor(uniform(random, 0.0, size + 1.0) / step); };
      const double x = place();
      corner = { x, place(), step * (random() % 5) };
    }
    Triangles triangles;
    triangles.add(corners);
    const std::vector<TexelDepths> texels = triangles.draw(raster, size, 0.0);
    counts.add(corners, size, texels);
  }
  counts.expectSound();
  EXPECT_GT(counts.touched, 20000u);
}

TEST_P(GpuRasterTest, drawsTrianglesThatTheMapCuts)
{
  GpuRaster raster(GetParam());
  Random random(33);
  Counts counts;
  for (const int size : { 17, 64, 255, 512, 1024 })
  {
    const std::vector<glm::dmat4> matrices = matricesFor(size);
    for (int i = 0; i < std::max(4, 3000 / size); ++i)
    {
      // Parallel rays alone: a triangle that large would reach behind a position.
      Triangles triangles(matrices[static_cast<std::size_t>(i % 3)]);
      const double flat = i % 5 < 3 ? 1.0 : std::pow(10.0, uniform(random, -4.0, -1.0));
      const double reach = size * std::pow(10.0, uniform(random, 0.0, 2.0));
      const double angle = uniform(random, 0.0, 6.2);
      const glm::dvec2 along(std::cos(angle), std::sin(angle));
      Corners corners;
      for (glm::dvec3& corner : corners)
      {
        const glm::dvec2 place(
          reach * uniform(random, -1.0, 1.0), flat * reach * uniform(random, -1.0, 1.0));
        corner = glm::dvec3(0.5 * size + place.x * along + place.y * glm::dvec2(-along.y, along.x),
          uniform(random, 0.0, 1.0));
      }
      triangles.add(corners);
      const std::vector<TexelDepths> texels =
        triangles.draw(raster, size, i % 4 < 2 ? marginTexels : 0.0);
      counts.add(triangles.corners().front(), size, texels);
    }
  }
  counts.expectSound();
  EXPECT_GT(counts.touched, 300000u);
  EXPECT_GT(counts.contained, 300000u);
  EXPECT_LT(static_cast<double>(counts.extra), 0.03 * static_cast<double>(counts.touched));
}

TEST_P(GpuRasterTest, drawsNeedlesOfWhichRoundingHidesHowTheyAreTurned)
{
  constexpr int size = 512;
  GpuRaster raster(GetParam());
  Random random(37);
  Counts counts;
  for (int i = 0; i < 60; ++i)
  {
    const auto vector = [&](double length)
    {
      return glm::dvec3(
        length * uniform(random, -1.0, 1.0), length * uniform(random, -1.0, 1.0), 0.0);
    };
    const glm::dvec3 end = glm::dvec3(60.0, 60.0, 0.5) + vector(50.0);
    const glm::dvec3 otherEnd = glm::dvec3(450.0, 450.0, 0.25) + vector(50.0);
    Corners corners{ end, otherEnd, end + vector(std::pow(10.0, uniform(random, -4.5, -3.0))) };
    std::rotate(corners.begin(), corners.begin() + i % 3, corners.end());
    Triangles triangles;
    triangles.add(corners);
    const std::vector<TexelDepths> texels = triangles.draw(raster, size, 0.0);
    counts.add(triangles.corners().front(), size, texels);
  }
  counts.expectSound();
  EXPECT_GT(counts.touched, 30000u);
  EXPECT_LT(static_cast<double>(counts.extra), 0.03 * static_cast<double>(counts.touched));
}

TEST_P(GpuRasterTest, keepsTheLeastOfManyTriangles)
{
  constexpr int size = 96;
  GpuRaster raster(GetParam());
  Random random(34);
  for (const glm::dmat4& matrix : matricesFor(size))
  {
    Triangles triangles(matrix);
    for (int i = 0; i < 800; ++i)
    {
      triangles.add(randomTriangle(random, size));
    }
    const std::vector<TexelDepths> texels = triangles.draw(raster, size, marginTexels);
    std::size_t wrong = 0, lit = 0, dark = 0;
    TexelBox{ glm::ivec2(0), glm::ivec2(size - 1) }.visit(
      [&](const glm::ivec2& texel)
      {
        const glm::dvec2 low(texel);
        double nearest = infinity, contained = infinity, slack = 0.0;
        for (const Corners& corners : triangles.corners())
        {
          if (overlap(corners, low, low + 1.0))
          {
            const auto [least, most] = depthsIn(corners, low);
            nearest = std::min(nearest, least);
            contained = contains(corners, low, low + 1.0) ? std::min(contained, most) : contained;
            slack = std::max(slack, roundingOf(corners));
          }
        }
        const TexelDepths& drawn = texels[static_cast<std::size_t>(texel.y * size + texel.x)];
        wrong += drawn.nearest > nearest + slack || drawn.contained < contained - slack ? 1 : 0;
        lit += drawn.nearest < std::numeric_limits<float>::infinity() ? 1 : 0;
        dark += drawn.contained < std::numeric_limits<float>::infinity() ? 1 : 0;
      });
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(lit, 4000u);
    EXPECT_GT(dark, 2000u);
  }
}

TEST_P(GpuRasterTest, boundsDepthsAsTightlyAsTheProcessorDoes)
{
  constexpr int size = 64;
  GpuRaster raster(GetParam());
  Random random(35);
  std::size_t compared = 0, looser = 0;
  for (int i = 0; i < 1000; ++i)
  {
    Triangles triangles;
    triangles.add(randomTriangle(random, size));
    const std::vector<TexelDepths> texels = triangles.draw(raster, size, marginTexels);
    std::vector<Cell> cells(texels.size());
    drawPolygon(
      polygonWith(triangles.corners().front()), marginTexels, size, { 0, size - 1 }, cells.data());
    for (std::size_t t = 0; t < texels.size(); ++t)
    {
      if (std::isfinite(cells[t].nearest) && std::isfinite(texels[t].nearest))
      {
        ++compared;
        looser += texels[t].nearest < cells[t].nearest - 1e-3f ? 1 : 0;
      }
      if (std::isfinite(cells[t].contained) && std::isfinite(texels[t].contained))
      {
        ++compared;
        looser += texels[t].contained > cells[t].contained + 1e-3f ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 20000u);
  EXPECT_LT(static_cast<double>(looser), 0.01 * static_cast<double>(compared));
}

TEST_P(GpuRasterTest, drawsWhatHasNoArea)
{
  constexpr int size = 32;
  GpuRaster raster(GetParam());
  Random random(36);
  Counts counts;
  for (int i = 0; i < 100; ++i)
  {
    // A point, an edge with a corner twice, or three corners in a row; along the grid or across it.
    const glm::dvec3 a(uniform(random, 0.0, size), uniform(random, 0.0, size), 0.25);
    const glm::dvec3 step(
      uniform(random, -9.0, 9.0), i % 2 ? 0.0 : uniform(random, -9.0, 9.0), 0.5);
    Triangles triangles;
    triangles.add(i % 3 == 0 ? Corners{ a, a, a }
        : i % 3 == 1         ? Corners{ a, a + step, a }
                             : Corners{ a, a + step, a - step });
    const std::vector<TexelDepths> texels = triangles.draw(raster, size, 0.0);
    for (std::size_t t = 0; t < texels.size(); ++t)
    {
      const glm::ivec2 texel(static_cast<int>(t) % size, static_cast<int>(t) / size);
      const glm::dvec2 low(texel);
      const bool drawn = texels[t].nearest < std::numeric_limits<float>::infinity();
      counts.touched += drawn ? 1 : 0;
      counts.missing += overlap(triangles.corners().front(), low, low + 1.0) && !drawn ? 1 : 0;
      EXPECT_FALSE(texels[t].contained < std::numeric_limits<float>::infinity());
      EXPECT_FALSE(std::isnan(texels[t].nearest) || std::isnan(texels[t].contained));
    }
  }
  EXPECT_EQ(counts.missing, 0u);
  EXPECT_GT(counts.touched, 500u);
  EXPECT_LT(counts.touched, 4000u) << "more than a few texels beside an edge";
}

TEST_P(GpuRasterTest, knowsNothingWhereATriangleReachesBehindTheLight)
{
  constexpr int size = 64;
  GpuRaster raster(GetParam());
  const glm::dmat4 matrix = matricesFor(size).back();
  const glm::dmat4 centredFromMap = glm::inverse(matrix);
  const auto centred = [&](double x, double y)
  {
    const glm::dvec4 place = centredFromMap * glm::dvec4(x, y, 0.5, 1.0);
    return glm::vec3(glm::dvec3(place) / place.w);
  };
  // The eye of the perspective, which W = 0 passes through.
  const glm::vec3 eye(3.0f, -4.0f, 5.0f);
  std::vector<TexelDepths> texels;
  for (const float behind : { -1.0f, 0.0f })
  {
    const glm::vec3 inFront = centred(20.0, 30.0);
    const glm::vec3 corner = eye + behind * 0.1f * (inFront - eye);
    raster.send({ inFront, corner, centred(25.0, 30.0) }, { { 0, 1, 2 } });
    raster.draw(matrix, size, marginTexels, texels);
    for (const TexelDepths& texel : texels)
    {
      EXPECT_EQ(texel.nearest, -std::numeric_limits<float>::infinity());
      EXPECT_EQ(texel.contained, std::numeric_limits<float>::infinity());
    }
  }
}

TEST_P(GpuRasterTest, refusesWhatIsNotFinite)
{
  GpuRaster raster(GetParam());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(raster.send({ { 0, 0, 0 }, { 1, nan, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } }),
    std::invalid_argument);
}

TEST_P(GpuRasterTest, leavesAMapWithoutTrianglesEmpty)
{
  GpuRaster raster(GetParam());
  std::vector<TexelDepths> texels;
  raster.send({}, {});
  raster.draw(glm::dmat4(1.0), 17, marginTexels, texels);
  ASSERT_EQ(texels.size(), 289u);
  EXPECT_TRUE(std::all_of(texels.begin(), texels.end(),
    [](const TexelDepths& texel)
    { return std::isinf(texel.nearest) && texel.nearest > 0.0f && std::isinf(texel.contained); }));
}

} // namespace
} // namespace gnomon::test
