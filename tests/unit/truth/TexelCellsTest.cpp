// The rasteriser of conservative maps, against cells and triangles compared one by one: which texels a triangle meets,
// which it contains, and what depths it has there.

#include "shadowtech/conservative/TexelCells.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int width = 32;

std::vector<Cell> drawn(const Corners& corners)
{
  std::vector<Cell> cells(width * width);
  drawPolygon(polygonWith(corners), marginTexels, width, { 0, width - 1 }, cells.data());
  return cells;
}

/// @param visit called with each triangle and the texels that it is drawn into
template <typename Visit>
void visitTriangles(int count, const Visit& visit)
{
  Random random(11);
  for (int i = 0; i < count; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    visit(corners, drawn(corners));
  }
}

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
  const glm::ivec2 last(glm::min(glm::floor(most) + 2.0, width - 1.0));
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      visit(glm::dvec2(x, y), static_cast<std::size_t>(y * width + x));
    }
  }
}

TEST(TexelCells, ofATriangleAreAllThatItMeetsAndHardlyMore)
{
  std::size_t meets = 0, missing = 0, extra = 0;
  visitTriangles(100000,
    [&](const Corners& corners, const std::vector<Cell>& cells)
    {
      visitCells(corners,
        [&](const glm::dvec2& low, std::size_t i)
        {
          const bool truth = overlap(corners, low, low + 1.0);
          const bool touched = std::isfinite(cells[i].nearest);
          meets += truth ? 1 : 0;
          missing += truth && !touched ? 1 : 0;
          extra += touched && !truth ? 1 : 0;
        });
    });
  EXPECT_EQ(missing, 0u);
  EXPECT_GT(meets, 1000000u);
  EXPECT_LT(static_cast<double>(extra), 0.03 * static_cast<double>(meets));
  RecordProperty("extraPercent", std::to_string(100.0 * extra / meets));
}

TEST(TexelCells, thatATriangleContainsAreNearlyAllOfThose)
{
  std::size_t contained = 0, missing = 0, extra = 0;
  visitTriangles(100000,
    [&](const Corners& corners, const std::vector<Cell>& cells)
    {
      visitCells(corners,
        [&](const glm::dvec2& low, std::size_t i)
        {
          const bool truth = contains(corners, low, low + 1.0);
          const bool said = std::isfinite(cells[i].contained);
          contained += truth ? 1 : 0;
          missing += truth && !said ? 1 : 0;
          extra += said && !truth ? 1 : 0;
        });
    });
  EXPECT_EQ(extra, 0u);
  EXPECT_GT(contained, 300000u);
  EXPECT_LT(static_cast<double>(missing), 0.02 * static_cast<double>(contained));
  RecordProperty("missingPercent", std::to_string(100.0 * missing / contained));
}

TEST(TexelCells, areNeverContainedWhereMovingTheSidesLeavesNothing)
{
  // With every side moved inwards by as much as a texel reaches along its normal, a triangle shrinks by the factor
  // k = 1 - (width + height of its box) / (twice its area); from k = 0 on the lines meet again, turned over.
  std::size_t empty = 0;
  Random random(12);
  for (int i = 0; i < 100000; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
    const glm::dvec2 box = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
    const double doubleArea = std::abs(doubleAreaOf(corners));
    const double k = 1.0 - (box.x + box.y) / doubleArea;
    if (k <= 0.0)
    {
      ++empty;
      const std::vector<Cell> cells = drawn(corners);
      EXPECT_TRUE(std::none_of(cells.begin(), cells.end(),
        [](const Cell& cell) { return std::isfinite(cell.contained); }));
    }
    if (doubleArea < 1e-2 * glm::dot(box, box))
    {
      continue; // the lines' crossings are far off
    }
    const Corners moved = withMovedSides(corners,
      [](const glm::dvec2& normal) { return 0.5 * (std::abs(normal.x) + std::abs(normal.y)); });
    const glm::dvec2 edge = b - a;
    const double ratio = glm::dot(glm::dvec2(moved[1] - moved[0]), edge) / glm::dot(edge, edge);
    EXPECT_NEAR(ratio, k, 1e-12 * (1.0 + std::abs(k)) * 100.0);
  }
  EXPECT_GT(empty, 10000u);
}

TEST(TexelCells, boundTheDepthsThatATriangleHasInThem)
{
  std::size_t samples = 0;
  visitTriangles(20000,
    [&](const Corners& corners, const std::vector<Cell>& cells)
    {
      const auto depthAt = depthOf(corners);
      // What float leaves of a depth of this size.
      const double rounding = 1e-6 *
        std::max({ 1.0, std::abs(corners[0].z), std::abs(corners[1].z), std::abs(corners[2].z) });
      visitCells(corners,
        [&](const glm::dvec2& low, std::size_t i)
        {
          for (int sample = 0; sample < 64; ++sample)
          {
            const glm::dvec2 point = low + glm::dvec2(sample % 8 + 0.5, sample / 8 + 0.5) / 8.0;
            if (isInside(corners, point))
            {
              ++samples;
              EXPECT_LE(cells[i].nearest, depthAt(point) + rounding);
              EXPECT_GE(cells[i].partAcross, depthAt(point) - rounding);
            }
          }
          if (std::isfinite(cells[i].contained))
          {
            EXPECT_EQ(cells[i].contained, cells[i].partAcross);
          }
        });
    });
  EXPECT_GT(samples, 1000000u);
}

} // namespace
} // namespace gnomon::test
