#pragma once

#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon
{

/// @file
/// Finds the texels that polygons and edges meet, row by row. The CPU converts each shape once to a
/// record, which shaders read as it lies in memory.
///
/// The rows are found here, or by the twins in texel_shapes.glsl. Neither divides nor fuses
/// operations, so both get the same texels and depths to the last bit. That takes OpenGL that
/// rounds to nearest even. GLSL does not promise it, so the tests check each driver.

/// Offset from a texel's centre of the sample at which layers are counted, in texels. Edges of
/// regular casters often pass through centres.
constexpr double sampleOffset = 1.0 / 61.0;
/// Width, in texels, by which triangles grow at samples. A sample on an edge then counts in both
/// triangles rather than in none.
constexpr double sampleOnEdge = 1e-6;

/// A side of a polygon: nx x + ny y + c >= 0 inside, with a unit normal.
struct SideRecord
{
  double perNx; ///< boundPerRest(nx)
  double ny, c;
  double support; ///< how far a texel reaches along the normal
};

/// A convex polygon, in the layout of the shaders.
struct PolygonRecord
{
  ///@{ Bounds of the centres of texels that it meets, and of its own x, in texels.
  double touchedLeft, touchedRight;
  double left, right;
  ///@}
  ///@{ Its plane: depth at a point, and its change per texel.
  double originX, originY, originDepth;
  double perX, perY;
  ///@}
  double toSample;      ///< change of depth from a texel's middle to its sample
  double spread;        ///< the most that depth changes from a texel's middle to anywhere in it
  float least, most;    ///< depths of its corners
  float climb;          ///< the most that depth changes from anywhere in a texel to its sample
  float slack;          ///< how far off its plane a tracer may see it, as depth
  float noise;          ///< the same in world units
  std::uint32_t covers; ///< 1 if it blocks every ray through its inside, else 0
  std::uint32_t firstSide, sideCount;
  std::int32_t firstRow, lastRow; ///< rows that it may meet
};
static_assert(sizeof(SideRecord) == 32 && sizeof(PolygonRecord) == 128, "as shaders read them");

/// A convex polygon on the grid of texels.
class PolygonOnTexels
{
public:
  /// @param margin of texels; a polygon that leaves texels undecided uses its own, if that is wider
  /// @param rows of the map, to which it is clipped
  PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows);

  /// Return the rows that it may meet.
  Span rows() const { return { this->record_.firstRow, this->record_.lastRow }; }

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

  /// Return the most that its depth changes from anywhere in a texel to the sample.
  float climb() const { return this->record_.climb; }

  /// Return how far off its plane a tracer may see it, in world units.
  float noise() const { return this->record_.noise; }

  /// Return the record for shaders. The caller fills in its first side.
  const PolygonRecord& record() const { return this->record_; }
  const SideRecord* sides() const { return this->sides_.data(); }

private:
  double depthAt(const Row& row, int x) const { return row.depth + this->record_.perX * x; }
  void findSides(const MapPolygon& polygon, double orientation, double margin);

  PolygonRecord record_;
  std::array<SideRecord, mostCorners> sides_;
};

/// An edge, in the layout of the shaders.
struct SegmentRecord
{
  double x, y, depth; ///< its first end
  double alongX;      ///< from the first end to the second
  double alongDepth;
  double perX, perY; ///< share of its length per texel; 0 if it does not run that way
  double margin;     ///< by which each texel grows
  double slack;      ///< how much nearer its depth may be; may be infinite
  std::uint32_t isEnd;
  std::int32_t firstRow, lastRow; ///< rows that it may meet
  std::uint32_t unused = 0;
};
static_assert(sizeof(SegmentRecord) == 88, "as shaders read it");

/// An edge on the grid of texels.
class SegmentOnTexels
{
public:
  /// @param margin of texels
  /// @param rows of the map, to which it is clipped
  SegmentOnTexels(const MapSegment& segment, double margin, Span rows);

  /// Return the rows that it may meet.
  Span rows() const { return { this->record_.firstRow, this->record_.lastRow }; }

  /// Visit the texels that it meets in one of its rows.
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
        // -infinity if slack is infinite
        visit(x,
          static_cast<float>(
            s.depth + std::min(part.first * s.alongDepth, part.last * s.alongDepth) - s.slack));
      }
    }
  }

  /// Return the record for shaders.
  const SegmentRecord& record() const { return this->record_; }

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

  SegmentRecord record_;
};

} // namespace gnomon
