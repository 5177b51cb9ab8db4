#pragma once

#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon
{

/// @file
/// Finds the texels that polygons and edges meet, row by row. Rows do without division, so a row
/// costs a multiplication per side.

/// Offset from a texel's centre of the sample at which layers are counted, in texels. Edges of
/// regular casters often pass through centres.
constexpr double sampleOffset = 1.0 / 61.0;
/// Width, in texels, by which triangles grow at samples. A sample on an edge then counts in both
/// triangles rather than in none.
constexpr double sampleOnEdge = 1e-6;

class PolygonOnTexels
{
public:
  /// @param margin of texels; a polygon that leaves texels undecided uses its own, if that is wider
  /// @param rows of the map, to which it is clipped
  PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    this->left_ = infinity;
    this->right_ = -infinity;
    this->least_ = std::numeric_limits<float>::infinity();
    this->most_ = -std::numeric_limits<float>::infinity();
    double low = infinity, high = -infinity;
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const MapCorner& corner = polygon.corners[i];
      this->left_ = std::min(this->left_, corner.x);
      this->right_ = std::max(this->right_, corner.x);
      low = std::min(low, corner.y);
      high = std::max(high, corner.y);
      this->least_ = std::min(this->least_, static_cast<float>(corner.depth));
      this->most_ = std::max(this->most_, static_cast<float>(corner.depth));
    }
    const double reach = polygon.role.poison ? std::max(margin, polygon.margin) : margin;
    this->touchedLeft_ = this->left_ - 0.5 - reach;
    this->touchedRight_ = this->right_ + 0.5 + reach;
    const Span inside = spanOf(low - reach, high + reach, rows.last + 1);
    this->firstRow_ = std::max(rows.first, inside.first);
    this->lastRow_ = inside.last;

    const MapPlane plane = planeOf(polygon);
    this->originX_ = plane.origin.x;
    this->originY_ = plane.origin.y;
    this->originDepth_ = plane.origin.depth;
    this->perX_ = plane.perX;
    this->perY_ = plane.perY;
    this->toSample_ = (plane.perX + plane.perY) * sampleOffset;
    const double slope = std::abs(plane.perX) + std::abs(plane.perY);
    this->spread_ = slope * (0.5 + reach);
    this->climb_ =
      static_cast<float>((slope * (0.5 + sampleOffset + reach) + polygon.slack) * 1.000001);
    this->slack_ = static_cast<float>(polygon.slack);
    this->noise_ = static_cast<float>(polygon.noise);
    this->findSides(polygon, plane.area > 0.0 ? 1.0 : -1.0, reach);
  }

  /// Return the rows that it may meet.
  Span rows() const { return { this->firstRow_, this->lastRow_ }; }

  struct Row
  {
    Span touched;   ///< texels that it meets
    Span contained; ///< texels that it contains
    Span sampled;   ///< texels whose sample it contains
    double depth;   ///< of its plane at the middle of the row's first texel
  };
  Row row(int y, int width) const
  {
    RowRange touched{ this->touchedLeft_, this->touchedRight_ };
    RowRange contained{ this->left_, this->right_ };
    RowRange sampled{ this->left_ - sampleOnEdge, this->right_ + sampleOnEdge };
    const double centre = y + 0.5;
    for (std::size_t i = 0; i < this->sideCount_; ++i)
    {
      const Side& side = this->sides_[i];
      const double rest = side.ny * centre + side.c;
      touched.cut(side.perNx, rest + side.support);
      contained.cut(side.perNx, rest - side.support);
      sampled.cut(side.perNx, rest + side.ny * sampleOffset + sampleOnEdge);
    }
    return { touched.texels(0.5, width), contained.texels(0.5, width),
      sampled.texels(0.5 + sampleOffset, width),
      this->originDepth_ + this->perX_ * (0.5 - this->originX_) +
        this->perY_ * (centre - this->originY_) };
  }

  ///@{
  /// Return bounds on its depth in a texel that it touches, and its depth at the sample.
  float nearest(const Row& row, int x) const
  {
    return std::max(this->least_, static_cast<float>(this->depthAt(row, x) - this->spread_)) -
      this->slack_;
  }
  float farthest(const Row& row, int x) const
  {
    return std::min(this->most_, static_cast<float>(this->depthAt(row, x) + this->spread_)) +
      this->slack_;
  }
  float atSample(const Row& row, int x) const
  {
    return static_cast<float>(this->depthAt(row, x) + this->toSample_);
  }
  ///@}

  /// Return the most that its depth changes from anywhere in a texel to the sample.
  float climb() const { return this->climb_; }

  /// Return how far off its plane a tracer may see it, in world units.
  float noise() const { return this->noise_; }

private:
  /// A side: nx x + ny y + c >= 0 inside, with a unit normal.
  struct Side
  {
    double perNx; ///< boundPerRest(nx)
    double ny, c;
    double support; ///< how far a texel reaches along the normal
  };

  double depthAt(const Row& row, int x) const { return row.depth + this->perX_ * x; }
  void findSides(const MapPolygon& polygon, double orientation, double margin)
  {
    this->sideCount_ = 0;
    for (std::size_t i = 0; i < polygon.count; ++i)
    {
      const MapCorner& a = polygon.corners[i];
      const MapCorner& b = polygon.corners[(i + 1) % polygon.count];
      const double ex = b.x - a.x, ey = b.y - a.y;
      const double length = std::hypot(ex, ey);
      if (length > 1e-9) // clipping may make corners coincide
      {
        const double nx = -orientation * ey / length, ny = orientation * ex / length;
        this->sides_[this->sideCount_++] = { boundPerRest(nx), ny, -(nx * a.x + ny * a.y),
          (std::abs(nx) + std::abs(ny)) * (0.5 + margin) };
      }
    }
  }

  ///@{ Bounds of the centres of texels that it meets, and of its own x, in texels.
  double touchedLeft_, touchedRight_;
  double left_, right_;
  ///@}
  ///@{ Its plane: depth at a point, and its change per texel.
  double originX_, originY_, originDepth_;
  double perX_, perY_;
  ///@}
  double toSample_;        ///< change of depth from a texel's middle to its sample
  double spread_;          ///< the most that depth changes from a texel's middle to anywhere in it
  float least_, most_;     ///< depths of its corners
  float climb_;            ///< the most that depth changes from anywhere in a texel to its sample
  float slack_;            ///< how far off its plane a tracer may see it, as depth
  float noise_;            ///< the same in world units
  int firstRow_, lastRow_; ///< rows that it may meet
  std::size_t sideCount_;
  std::array<Side, mostCorners> sides_;
};

/// An edge on the grid of texels.
class SegmentOnTexels
{
public:
  /// @param margin of texels
  /// @param rows of the map, to which it is clipped
  SegmentOnTexels(const MapSegment& segment, double margin, Span rows)
  {
    const auto& [a, b] = segment.ends;
    const auto perTexel = [](double extent)
    { return std::abs(extent) < 1e-12 ? 0.0 : 1.0 / extent; };
    this->x_ = a.x;
    this->y_ = a.y;
    this->depth_ = a.depth;
    this->alongX_ = b.x - a.x;
    this->alongDepth_ = b.depth - a.depth;
    this->perX_ = perTexel(b.x - a.x);
    this->perY_ = perTexel(b.y - a.y);
    this->margin_ = margin + thinTexels;
    this->slack_ = segment.slack;
    const Span inside =
      spanOf(std::min(a.y, b.y) - this->margin_, std::max(a.y, b.y) + this->margin_, rows.last + 1);
    this->firstRow_ = std::max(rows.first, inside.first);
    this->lastRow_ = inside.last;
  }

  /// Return the rows that it may meet.
  Span rows() const { return { this->firstRow_, this->lastRow_ }; }

  /// Visit the texels that it meets in one of its rows.
  /// @param visit called with the column and the edge's least depth there
  template <typename Visit>
  void visitRow(int y, int width, const Visit& visit) const
  {
    Part ofRow{ 0.0, 1.0 };
    if (!ofRow.keepBetween(this->y_, this->perY_, y - this->margin_, y + 1.0 + this->margin_))
    {
      return;
    }
    const double x0 = this->x_ + ofRow.first * this->alongX_;
    const double x1 = this->x_ + ofRow.last * this->alongX_;
    const Span columns =
      spanOf(std::min(x0, x1) - this->margin_, std::max(x0, x1) + this->margin_, width);
    for (int x = columns.first; x <= columns.last; ++x)
    {
      Part part = ofRow;
      if (part.keepBetween(this->x_, this->perX_, x - this->margin_, x + 1.0 + this->margin_))
      {
        // -infinity if slack is infinite
        visit(x,
          static_cast<float>(this->depth_ +
            std::min(part.first * this->alongDepth_, part.last * this->alongDepth_) -
            this->slack_));
      }
    }
  }

private:
  /// A part of the edge, from 0 at its first end to 1.
  struct Part
  {
    double first, last;

    /// Clip to where one coordinate lies between low and high.
    /// @param from coordinate of the edge's first end
    /// @param perTexel share of its length per texel; 0 if it does not run that way
    /// @return false if nothing is left
    bool keepBetween(double from, double perTexel, double low, double high)
    {
      if (perTexel == 0.0)
      {
        return from >= low - 1e-9 && from <= high + 1e-9;
      }
      const double t0 = (low - from) * perTexel;
      const double t1 = (high - from) * perTexel;
      this->first = std::max(this->first, std::min(t0, t1));
      this->last = std::min(this->last, std::max(t0, t1));
      return this->first <= this->last;
    }
  };

  double x_, y_, depth_; ///< its first end
  double alongX_;        ///< from the first end to the second
  double alongDepth_;
  double perX_, perY_;     ///< share of its length per texel; 0 if it does not run that way
  double margin_;          ///< by which each texel grows
  double slack_;           ///< how much nearer its depth may be; may be infinite
  int firstRow_, lastRow_; ///< rows that it may meet
};

} // namespace gnomon
