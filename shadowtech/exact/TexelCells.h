#pragma once

#include "shadowtech/exact/TexelShapes.h"
#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace gnomon
{

/// @file
/// Gathers values per texel of a conservative map while casters are rasterized.

/// The values of a texel. docs/theory/exact_maps.md explains them: N is `nearest`, C `contained`, E
/// `sharpEnd`, G `climb`, S `second`. The unit is depth unless noted.
struct Cell
{
  static constexpr float never = std::numeric_limits<float>::infinity();

  float nearest = never; ///< the least depth of a caster or an end
  /// The least, over casters that cover the texel, of their largest depths.
  float contained = never;
  /// The most, in world units, that a tracer may see a triangle off its plane. Only triangles that
  /// begin before oneLayerUpTo() count.
  float noise = 0.0f;
  float climb = 0.0f;     ///< the most that depth changes from anywhere in the texel to the sample
  float sharpEnd = never; ///< the least depth of an end or a sharp edge
  float first = never;    ///< the least depth of triangles at the sample
  float second = never;   ///< the second least

  ///@{
  /// Values of the part of the casters' surface that is being rasterized.
  CasterPart part = noPart;
  float partAcross = never; ///< the least of its triangles' largest depths
  float partEnd = never;    ///< the least depth of its ends
  float partClimb = 0.0f;   ///< the largest climb of its triangles
  ///@}
  /// The least depth from which one of the parts rasterized so far covers the texel.
  float covered = never;

  /// Turn to the next part. Parts must be rasterized one after another, each once. Several parts
  /// taken for one only decide less. Pieces of one part would be wrong, as a piece does not know
  /// the ends in others.
  void turnTo(CasterPart next)
  {
    if (next == this->part)
    {
      return;
    }
    // Where the part's depth is at most partAcross, nothing ends it, so it covers the whole texel.
    // Depth climbs at most twice, by way of the sample.
    const float everywhere = this->partAcross + 2.0f * this->partClimb;
    this->covered =
      this->partEnd > everywhere ? std::min(this->covered, everywhere) : this->covered;
    this->part = next;
    this->partAcross = this->partEnd = never;
    this->partClimb = 0.0f;
  }

  /// Return the depth up to which there is one layer, if any. Walks from anywhere before it reach
  /// the sample before the second layer, and meet no end.
  float oneLayerUpTo() const { return std::min(this->second, this->sharpEnd) - this->climb; }

  void addLayer(float depth)
  {
    this->second = std::min(this->second, std::max(this->first, depth));
    this->first = std::min(this->first, depth);
  }
};

/// Rasterize a polygon into some rows. Of polygons along the light (MapPolygon::facing), only the
/// edges count.
/// @param texels the polygon among the texels. All casters need the same margin, because walks from
/// a texel to an edge must not lose an edge taken to be farther away.
/// @param cells of those rows, `width` each
void drawPolygon(
  const MapPolygon& polygon, const PolygonOnTexels& texels, int width, Span rows, Cell* cells);

/// Gather the noise of a polygon that does not lie along the light and begins before
/// Cell::oneLayerUpTo(). All edges and polygons must be rasterized before. Polygons behind lie
/// behind the receivers that the rule lights, wherever a tracer sees them.
void drawNoise(const PolygonOnTexels& texels, int width, Span rows, Cell* cells);

/// Call `agrees` with each texel that a polygon touches, and bounds on its depth there, until it
/// returns false.
/// @return true if it never did
bool allTexels(const MapPolygon& polygon, double margin, int width,
  const std::function<bool(int x, int y, float nearest, float farthest)>& agrees);

/// A ring: a triangle and the neighbours that continue its surface. It covers every texel that it
/// meets, except those on its border.
struct MapRing
{
  std::vector<MapPolygon> triangles; ///< the middle first; all of them cover
  std::vector<MapSegment> border;    ///< all edges that no two of the triangles share
};

/// Gather where a ring covers texels that its middle touches.
void drawRing(const MapRing& ring, double margin, int width, Span rows, Cell* cells);

/// Gather an end of a part of the casters' surface. Call it before the part's triangles are
/// rasterized, as triangles behind an end do not count for its climb.
void drawEndOfPart(const MapSegment& segment, double margin, int width, Span rows, Cell* cells);

/// Rasterize an edge into some rows.
void drawSegment(const MapSegment& segment, double margin, int width, Span rows, Cell* cells);

} // namespace gnomon
