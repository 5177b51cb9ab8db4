#pragma once

#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <algorithm>
#include <array>
#include <cstddef>

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

/// A convex polygon on the grid of texels.
class PolygonOnTexels
{
public:
  /// @param margin of texels; a polygon that leaves texels undecided uses its own, if that is wider
  /// @param rows of the map, to which it is clipped
  PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows);

  /// Return the rows that it may meet.
  Span rows() const { return { this->firstRow_, this->lastRow_ }; }

  /// The polygon's spans in a row of texels.
  struct Row
  {
    Span touched;   ///< texels that it meets
    Span contained; ///< texels that it contains
    Span sampled;   ///< texels whose sample it contains
    double depth;   ///< of its plane at the middle of the row's first texel
  };
  Row row(int y, int width) const;

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
  void findSides(const MapPolygon& polygon, double orientation, double margin);

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
  SegmentOnTexels(const MapSegment& segment, double margin, Span rows);

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
