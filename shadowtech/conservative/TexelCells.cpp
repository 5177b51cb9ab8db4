#include "shadowtech/conservative/TexelCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where layers are counted in a texel: off its centre, where the edges of regular casters often are.
constexpr double sampleOffset = 1.0 / 61.0;

/// What a polygon is to the texels, row by row.
class PolygonOnTexels
{
public:
  PolygonOnTexels(const MapPolygon& polygon, double margin)
    : polygon_(polygon)
    , margin_(margin)
  {
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const MapCorner& corner = polygon.corners[i];
      this->left_ = std::min(this->left_, corner.x);
      this->right_ = std::max(this->right_, corner.x);
      this->low_ = std::min(this->low_, corner.y);
      this->high_ = std::max(this->high_, corner.y);
      this->least_ = std::min(this->least_, static_cast<float>(corner.depth));
      this->most_ = std::max(this->most_, static_cast<float>(corner.depth));
    }
    this->plane_ = planeOf(polygon);
    this->findSides();
    const double slope = std::abs(this->plane_.perX) + std::abs(this->plane_.perY);
    this->half_ = slope * (0.5 + margin);
    this->climb_ =
      static_cast<float>((slope * (0.5 + sampleOffset + margin) + polygon.slack) * 1.000001);
    this->slack_ = static_cast<float>(polygon.slack);
  }

  /// The rows, of these, in which it may be.
  Span rows(Span of) const
  {
    const Span inside =
      spanOf(this->low_ - this->margin_, this->high_ + this->margin_, of.last + 1);
    return { std::max(of.first, inside.first), inside.last };
  }

  /// A row of texels.
  struct Row
  {
    Span touched;   ///< those that it is in
    Span contained; ///< those that it contains
    Span sampled;   ///< those whose sample it contains
    double depth;   ///< of its plane, at the middle of the first texel
  };
  Row row(int y, int width) const
  {
    RowRange touched{ this->left_ - 0.5 - this->margin_, this->right_ + 0.5 + this->margin_ };
    RowRange contained{ this->left_, this->right_ };
    RowRange sampled{ this->left_ - onEdge, this->right_ + onEdge };
    const double centre = y + 0.5;
    for (std::size_t i = 0; i < this->sideCount_; ++i)
    {
      const Side& side = this->sides_[i];
      const double rest = side.ny * centre + side.c;
      touched.cut(side.nx, rest + side.support);
      contained.cut(side.nx, rest - side.support);
      sampled.cut(side.nx, rest + side.ny * sampleOffset + onEdge);
    }
    return { touched.texels(0.5, width), contained.texels(0.5, width),
      sampled.texels(0.5 + sampleOffset, width), this->plane_.depthAt(0.5, centre) };
  }

  ///@{
  /// Bounds on its depth in a texel that it touches, and its depth at the sample.
  float nearest(const Row& row, int x) const
  {
    return std::max(this->least_, static_cast<float>(this->depthAt(row, x) - this->half_)) -
      this->slack_;
  }
  float farthest(const Row& row, int x) const
  {
    return std::min(this->most_, static_cast<float>(this->depthAt(row, x) + this->half_)) +
      this->slack_;
  }
  float atSample(const Row& row, int x) const
  {
    return static_cast<float>(
      this->depthAt(row, x) + (this->plane_.perX + this->plane_.perY) * sampleOffset);
  }
  ///@}

  /// The most that its depth changes from anywhere in a texel to the sample.
  float climb() const { return this->climb_; }

private:
  /// nx x + ny y + c >= 0 inside, with unit normals.
  struct Side
  {
    double nx, ny, c;
    double support; ///< how far a texel reaches along the normal
  };

  /// A sample on an edge is in both of its triangles: counted twice rather than not at all.
  static constexpr double onEdge = 1e-6;

  double depthAt(const Row& row, int x) const { return row.depth + this->plane_.perX * x; }

  void findSides()
  {
    const double orientation = this->plane_.area > 0.0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < this->polygon_.count; ++i)
    {
      const MapCorner& a = this->polygon_.corners[i];
      const MapCorner& b = this->polygon_.corners[(i + 1) % this->polygon_.count];
      const double ex = b.x - a.x, ey = b.y - a.y;
      const double length = std::hypot(ex, ey);
      if (length > 1e-9) // corners may fall together where polygons are cut
      {
        const double nx = -orientation * ey / length, ny = orientation * ex / length;
        this->sides_[this->sideCount_++] = { nx, ny, -(nx * a.x + ny * a.y),
          (std::abs(nx) + std::abs(ny)) * (0.5 + this->margin_) };
      }
    }
  }

  const MapPolygon& polygon_;
  double margin_;
  double left_ = infinity, right_ = -infinity, low_ = infinity, high_ = -infinity;
  float least_ = std::numeric_limits<float>::infinity();
  float most_ = -std::numeric_limits<float>::infinity();
  MapPlane plane_;
  double half_ = 0.0; ///< how much depth changes from a texel's middle
  float climb_ = 0.0f, slack_ = 0.0f;
  std::array<Side, mostCorners> sides_;
  std::size_t sideCount_ = 0;
};

/// The part of the parameter's range [first, last] in which low <= from + t (to - from) <= high.
/// @return whether there is one
bool keepBetween(double from, double to, double low, double high, double& first, double& last)
{
  const double extent = to - from;
  if (std::abs(extent) < 1e-12)
  {
    return from >= low - 1e-9 && from <= high + 1e-9;
  }
  const double t0 = (low - from) / extent;
  const double t1 = (high - from) / extent;
  first = std::max(first, std::min(t0, t1));
  last = std::min(last, std::max(t0, t1));
  return first <= last;
}

/// Visits the texels that an edge meets, in some rows.
/// @param visit called with column, row, and which part of the edge, between 0 and 1, is in the texel
template <typename Visit>
void visitTexels(
  const MapSegment& segment, double texelMargin, int width, Span rows, const Visit& visit)
{
  const auto& [a, b] = segment.ends;
  const double margin = texelMargin + thinTexels;
  const Span inside =
    spanOf(std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin, rows.last + 1);
  for (int y = std::max(rows.first, inside.first); y <= inside.last; ++y)
  {
    double rowFirst = 0.0, rowLast = 1.0;
    if (!keepBetween(a.y, b.y, y - margin, y + 1.0 + margin, rowFirst, rowLast))
    {
      continue;
    }
    const double x0 = a.x + rowFirst * (b.x - a.x);
    const double x1 = a.x + rowLast * (b.x - a.x);
    const Span columns = spanOf(std::min(x0, x1) - margin, std::max(x0, x1) + margin, width);
    for (int x = columns.first; x <= columns.last; ++x)
    {
      double first = rowFirst, last = rowLast;
      if (keepBetween(a.x, b.x, x - margin, x + 1.0 + margin, first, last))
      {
        visit(x, y, first, last);
      }
    }
  }
}

/// Visits the texels that an edge meets, in some rows.
/// @param visit called with the cell, and with the edge's least depth in it
template <typename Visit>
void visitCells(
  const MapSegment& segment, double margin, int width, Span rows, Cell* cells, const Visit& visit)
{
  const double start = segment.ends[0].depth;
  const double extent = segment.ends[1].depth - start;
  visitTexels(segment, margin, width, rows,
    [&](int x, int y, double first, double last)
    {
      // -infinity with endless slack
      const auto depth =
        static_cast<float>(start + std::min(first * extent, last * extent) - segment.slack);
      visit(cells[static_cast<std::ptrdiff_t>(y - rows.first) * width + x], depth);
    });
}

} // namespace

//------------------------------------------------------------------------------
void drawPolygon(const MapPolygon& polygon, double margin, int width, Span rows, Cell* cells)
{
  if (polygon.facing == 0 && !polygon.role.poison)
  {
    return; // its edges alone are drawn
  }
  const PolygonOnTexels texels(
    polygon, polygon.role.poison ? std::max(margin, polygon.margin) : margin);
  const Span drawn = texels.rows(rows);
  for (int y = drawn.first; y <= drawn.last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const PolygonOnTexels::Row row = texels.row(y, width);
    if (polygon.role.poison)
    {
      for (int x = row.touched.first; x <= row.touched.last; ++x)
      {
        cell[x].turnTo(polygon.part);
        cell[x].nearest = cell[x].partEnd = cell[x].sharpEnd =
          -std::numeric_limits<float>::infinity();
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
        cell[x].noise = std::max(cell[x].noise, static_cast<float>(polygon.noise));
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

//------------------------------------------------------------------------------
bool allTexels(const MapPolygon& polygon, double margin, int width,
  const std::function<bool(int x, int y, float nearest, float farthest)>& agrees)
{
  const PolygonOnTexels texels(polygon, margin);
  const Span rows = texels.rows({ 0, width - 1 });
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

//------------------------------------------------------------------------------
void drawRing(const MapRing& ring, double margin, int width, Span rows, Cell* cells)
{
  std::vector<PolygonOnTexels> triangles;
  triangles.reserve(ring.triangles.size());
  for (const MapPolygon& triangle : ring.triangles)
  {
    triangles.emplace_back(triangle, margin);
  }
  const PolygonOnTexels& middle = triangles.front();
  const Span drawn = middle.rows(rows);
  std::vector<float> farthest; // of the texels in a row that the middle touches
  for (int y = drawn.first; y <= drawn.last; ++y)
  {
    Cell* const cell = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const Span touched = middle.row(y, width).touched;
    if (touched.first > touched.last)
    {
      continue;
    }
    farthest.assign(static_cast<std::size_t>(touched.last - touched.first + 1),
      -std::numeric_limits<float>::infinity());
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
    // Where the ring's border is not, its triangles go on everywhere.
    for (const MapSegment& border : ring.border)
    {
      visitTexels(border, margin, width, { y, y },
        [&](int x, int, double, double)
        {
          if (x >= touched.first && x <= touched.last)
          {
            at(x) = std::numeric_limits<float>::infinity();
          }
        });
    }
    for (int x = touched.first; x <= touched.last; ++x)
    {
      cell[x].contained = std::min(cell[x].contained, at(x));
    }
  }
}

//------------------------------------------------------------------------------
void drawEndOfPart(const MapSegment& segment, double margin, int width, Span rows, Cell* cells)
{
  visitCells(segment, margin, width, rows, cells,
    [&](Cell& cell, float depth)
    {
      cell.turnTo(segment.part);
      cell.partEnd = std::min(cell.partEnd, depth);
    });
}

//------------------------------------------------------------------------------
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
