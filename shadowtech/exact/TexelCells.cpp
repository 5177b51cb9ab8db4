#include "shadowtech/exact/TexelCells.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon
{

namespace
{

/// Visit the texels that an edge meets in some rows.
/// @param visit called with the cell and the edge's least depth in it
template <typename Visit>
void visitCells(
  const MapSegment& segment, double margin, int width, Span rows, Cell* cells, const Visit& visit)
{
  const SegmentOnTexels texels(segment, margin, rows);
  for (int y = texels.rows().first; y <= texels.rows().last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    texels.visitRow(y, width, [&](int x, float depth) { visit(cell[x], depth); });
  }
}

} // namespace

void drawPolygon(
  const MapPolygon& polygon, const PolygonOnTexels& texels, int width, Span rows, Cell* cells)
{
  if (polygon.facing == 0 && !polygon.role.poison)
  {
    return; // only its edges are rasterized
  }
  const Span drawn = texels.rows();
  for (int y = drawn.first; y <= drawn.last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const PolygonOnTexels::Row row = texels.row(y, width);
    if (polygon.role.poison)
    {
      for (int x = row.touched.first; x <= row.touched.last; ++x)
      {
        cell[x].turnTo(polygon.part);
        cell[x].nearest = cell[x].partEnd = cell[x].sharpEnd = -Cell::never;
      }
      continue;
    }
    for (int x = row.touched.first; x <= row.touched.last; ++x)
    {
      const float nearest = texels.nearest(row, x);
      cell[x].nearest = std::min(cell[x].nearest, nearest);
      if (nearest < cell[x].sharpEnd)
      {
        cell[x].climb = std::max(cell[x].climb, texels.climb());
      }
      cell[x].turnTo(polygon.part);
      if (nearest < cell[x].partEnd)
      {
        cell[x].partClimb = std::max(cell[x].partClimb, texels.climb());
      }
      if (polygon.role.covers)
      {
        cell[x].partAcross = std::min(cell[x].partAcross, texels.farthest(row, x));
      }
    }
    for (int x = row.sampled.first; x <= row.sampled.last; ++x)
    {
      cell[x].addLayer(texels.atSample(row, x));
    }
    for (int x = row.contained.first; polygon.role.covers && x <= row.contained.last; ++x)
    {
      cell[x].contained = std::min(cell[x].contained, texels.farthest(row, x));
    }
  }
}

void drawNoise(const PolygonOnTexels& texels, int width, Span rows, Cell* cells)
{
  const Span drawn = texels.rows();
  for (int y = drawn.first; y <= drawn.last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const PolygonOnTexels::Row row = texels.row(y, width);
    for (int x = row.touched.first; x <= row.touched.last; ++x)
    {
      if (texels.nearest(row, x) < cell[x].oneLayerUpTo())
      {
        cell[x].noise = std::max(cell[x].noise, texels.noise());
      }
    }
  }
}

bool allTexels(const MapPolygon& polygon, double margin, int width,
  const std::function<bool(int x, int y, float nearest, float farthest)>& agrees)
{
  const PolygonOnTexels texels(polygon, margin, { 0, width - 1 });
  const Span rows = texels.rows();
  for (int y = rows.first; y <= rows.last; ++y)
  {
    const PolygonOnTexels::Row row = texels.row(y, width);
    for (int x = row.touched.first; x <= row.touched.last; ++x)
    {
      if (!agrees(x, y, texels.nearest(row, x), texels.farthest(row, x)))
      {
        return false;
      }
    }
  }
  return true;
}

void drawRing(const MapRing& ring, double margin, int width, Span rows, Cell* cells)
{
  std::vector<PolygonOnTexels> triangles;
  triangles.reserve(ring.triangles.size());
  for (const MapPolygon& triangle : ring.triangles)
  {
    triangles.emplace_back(triangle, margin, rows);
  }
  const PolygonOnTexels& middle = triangles.front();
  const Span drawn = middle.rows();
  std::vector<SegmentOnTexels> borders;
  borders.reserve(ring.border.size());
  for (const MapSegment& border : ring.border)
  {
    borders.emplace_back(border, margin, rows);
  }
  std::vector<float> farthest; // for texels of the row that the middle touches
  for (int y = drawn.first; y <= drawn.last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const Span touched = middle.row(y, width).touched;
    if (touched.first > touched.last)
    {
      continue;
    }
    farthest.assign(static_cast<std::size_t>(touched.last - touched.first + 1), -Cell::never);
    const auto at = [&](int x) -> float&
    { return farthest[static_cast<std::size_t>(x - touched.first)]; };
    for (const PolygonOnTexels& triangle : triangles)
    {
      const PolygonOnTexels::Row row = triangle.row(y, width);
      for (int x = std::max(touched.first, row.touched.first);
           x <= std::min(touched.last, row.touched.last); ++x)
      {
        at(x) = std::max(at(x), triangle.farthest(row, x));
      }
    }
    // Off the ring's border, its triangles cover the whole texel.
    for (const SegmentOnTexels& border : borders)
    {
      if (y < border.rows().first || y > border.rows().last)
      {
        continue;
      }
      border.visitRow(y, width,
        [&](int x, float)
        {
          if (x >= touched.first && x <= touched.last)
          {
            at(x) = Cell::never;
          }
        });
    }
    for (int x = touched.first; x <= touched.last; ++x)
    {
      cell[x].contained = std::min(cell[x].contained, at(x));
    }
  }
}

void drawEndOfPart(const MapSegment& segment, double margin, int width, Span rows, Cell* cells)
{
  visitCells(segment, margin, width, rows, cells,
    [&](Cell& cell, float depth)
    {
      cell.turnTo(segment.part);
      cell.partEnd = std::min(cell.partEnd, depth);
    });
}

void drawSegment(const MapSegment& segment, double margin, int width, Span rows, Cell* cells)
{
  visitCells(segment, margin, width, rows, cells,
    [&](Cell& cell, float depth)
    {
      cell.sharpEnd = std::min(cell.sharpEnd, depth);
      if (segment.isEnd)
      {
        cell.nearest = std::min(cell.nearest, depth);
      }
    });
}

} // namespace gnomon
