#pragma once

#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon
{

/// @file
/// What polygons and edges are to the texels of a map, row by row. Each is made ready once, on the
/// CPU; which texels it meets is then found here or by the twins in texel_shapes.glsl, which read
/// the records as they lie in memory. Neither divides or fuses, so that both get the same texels
/// and depths to the last bit where OpenGL rounds to nearest even, which the tests check for each
/// driver: GLSL leaves that open.

/// Where layers are counted in a texel: off its centre, where the edges of regular casters often
/// are.
constexpr double sampleOffset = 1.0 / 61.0;
/// A sample on an edge is in both of its triangles: counted twice rather than not at all.
constexpr double sampleOnEdge = 1e-6;

/// A polygon's side: nx x + ny y + c >= 0 inside, with a unit normal.
struct SideRecord
{
  double perNx; ///< boundPerRest(nx)
  double ny, c;
  double support; ///< how far a texel reaches along the normal
};

/// A convex polygon, as shaders read it.
struct PolygonRecord
{
  ///@{ Columns between which centres of texels lie that it meets, and of its own places.
  double touchedLeft, touchedRight;
  double left, right;
  ///@}
  ///@{ Its plane: the depth at a place, and what that changes by to a texel.
  double originX, originY, originDepth;
  double perX, perY;
  ///@}
  double toSample;      ///< how much that changes from a texel's middle to its sample
  double spread;        ///< how much, at most, from its middle to anywhere in it
  float least, most;    ///< its corners' depths
  float climb;          ///< how much depth changes, at most, from anywhere in a texel to its sample
  float slack;          ///< depth that a tracer may see it off its plane
  float noise;          ///< and how far, in world units
  std::uint32_t covers; ///< whether it blocks all over
  std::uint32_t firstSide, sideCount;
  std::int32_t firstRow, lastRow; ///< those that it may meet
};
static_assert(sizeof(SideRecord) == 32 && sizeof(PolygonRecord) == 128, "as shaders read them");

/// A convex polygon among the texels.
class PolygonOnTexels
{
public:
  /// @param margin of texels; one that spoils texels has its own, where that is wider
  /// @param rows of the map in which it is looked for
  PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows);

  /// Those of the rows in which it may be.
  Span rows() const { return { this->record_.firstRow, this->record_.lastRow }; }

  /// A row of texels.
  struct Row
  {
    Span touched;   ///< those that it is in
    Span contained; ///< those that it contains
    Span sampled;   ///< those whose sample it contains
    double depth;   ///< of its plane, at the middle of the first texel
  };
  Row row(int y, int width) const;

  ///@{
  /// Bounds on its depth in a texel that it touches, and its depth at the sample.
  float nearest(const Row& row, int x) const
  {
    return std::max(this->record_.least,
             static_cast<float>(this->depthAt(row, x) - this->record_.spread)) -
      this->record_.slack;
  }
  float farthest(const Row& row, int x) const
  {
    return std::min(
             this->record_.most, static_cast<float>(this->depthAt(row, x) + this->record_.spread)) +
      this->record_.slack;
  }
  float atSample(const Row& row, int x) const
  {
    return static_cast<float>(this->depthAt(row, x) + this->record_.toSample);
  }
  ///@}

  /// The most that its depth changes from anywhere in a texel to the sample.
  float climb() const { return this->record_.climb; }

  /// How far off its plane a tracer may see it, in world units.
  float noise() const { return this->record_.noise; }

  /// For shaders; its first side is to be filled in.
  const PolygonRecord& record() const { return this->record_; }
  const SideRecord* sides() const { return this->sides_.data(); }

private:
  double depthAt(const Row& row, int x) const { return row.depth + this->record_.perX * x; }
  void findSides(const MapPolygon& polygon, double orientation, double margin);

  PolygonRecord record_;
  std::array<SideRecord, mostCorners> sides_;
};

/// An edge, as shaders read it.
struct SegmentRecord
{
  double x, y, depth; ///< where it starts
  double alongX;      ///< how far it goes
  double alongDepth;
  double perX, perY; ///< of its way that is done to a texel; 0 where it does not go that way
  double margin;     ///< by which texels are larger
  double slack;      ///< depth that it may be nearer; may be infinite
  std::uint32_t isEnd;
  std::int32_t firstRow, lastRow; ///< those that it may meet
  std::uint32_t unused = 0;
};
static_assert(sizeof(SegmentRecord) == 88, "as shaders read it");

/// An edge among the texels.
class SegmentOnTexels
{
public:
  /// @param margin of texels
  /// @param rows of the map in which it is looked for
  SegmentOnTexels(const MapSegment& segment, double margin, Span rows);

  /// Those of the rows in which it may be.
  Span rows() const { return { this->record_.firstRow, this->record_.lastRow }; }

  /// Visits the texels of one of the rows that it meets.
  /// @param visit called with the column and the edge's least depth there
  template <typename Visit>
  void visitRow(int y, int width, const Visit& visit) const
  {
    const SegmentRecord& s = this->record_;
    Part ofRow{ 0.0, 1.0 };
    if (!ofRow.keepBetween(s.y, s.perY, y - s.margin, y + 1.0 + s.margin))
    {
      return;
    }
    const double x0 = s.x + ofRow.first * s.alongX;
    const double x1 = s.x + ofRow.last * s.alongX;
    const Span columns = spanOf(std::min(x0, x1) - s.margin, std::max(x0, x1) + s.margin, width);
    for (int x = columns.first; x <= columns.last; ++x)
    {
      Part part = ofRow;
      if (part.keepBetween(s.x, s.perX, x - s.margin, x + 1.0 + s.margin))
      {
        // -infinity with endless slack
        visit(x,
          static_cast<float>(
            s.depth + std::min(part.first * s.alongDepth, part.last * s.alongDepth) - s.slack));
      }
    }
  }

  /// For shaders.
  const SegmentRecord& record() const { return this->record_; }

private:
  /// Which part of the edge, between 0 and 1.
  struct Part
  {
    double first, last;

    /// Leaves what lies between low and high.
    /// @param from where the edge starts
    /// @param perTexel what of it is done to a texel; 0 where it does not go that way
    /// @return whether there is any
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

  SegmentRecord record_;
};

} // namespace gnomon
