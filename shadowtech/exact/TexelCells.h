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
/// What is gathered of a map's texels while casters are drawn into them.

/// What is gathered of a texel while casters are drawn.
struct Cell
{
  float nearest = std::numeric_limits<float>::infinity(); ///< the least depth of a caster
  float contained = std::numeric_limits<
    float>::infinity(); ///< the least, over casters that cover the texel, of their largest depths
  /// The most that a tracer may see a triangle off its plane, of those that begin before
  /// oneLayerUpTo(), in world units.
  float noise = 0.0f;
  float climb = 0.0f; ///< the most that depth changes from anywhere to the sample
  float sharpEnd =
    std::numeric_limits<float>::infinity(); ///< the least depth of an end or a sharp edge
  float first = std::numeric_limits<float>::infinity();  ///< depth of the first layer at the sample
  float second = std::numeric_limits<float>::infinity(); ///< and of the second

  ///@{
  /// Of the part of the casters' surface that is being drawn.
  CasterPart part = noPart;
  float partAcross =
    std::numeric_limits<float>::infinity(); ///< the least of its triangles' largest depths
  float partEnd = std::numeric_limits<float>::infinity(); ///< the least depth of an end
  float partClimb = 0.0f;                                 ///< of its triangles, the most
  ///@}
  /// The least depth from which a part covers the texel, of those that were drawn before.
  float covered = std::numeric_limits<float>::infinity();

  /// Turns to a part. They are drawn one after another, each once: what is taken for one part may
  /// be several, which only decides less, but of a part that is drawn in pieces a piece would not
  /// know where the others end.
  void turnTo(CasterPart next)
  {
    if (next == this->part)
    {
      return;
    }
    // From where the part is no deeper than partAcross it goes on all over the texel, as nothing
    // ends it, and climbs no more than twice to the sample.
    const float everywhere = this->partAcross + 2.0f * this->partClimb;
    this->covered =
      this->partEnd > everywhere ? std::min(this->covered, everywhere) : this->covered;
    this->part = next;
    this->partAcross = this->partEnd = std::numeric_limits<float>::infinity();
    this->partClimb = 0.0f;
  }

  /// Up to what depth there is one layer, if any: from anywhere before it walks come to the sample
  /// before the second, and meet no end.
  float oneLayerUpTo() const { return std::min(this->second, this->sharpEnd) - this->climb; }

  void addLayer(float depth)
  {
    this->second = std::min(this->second, std::max(this->first, depth));
    this->first = std::min(this->first, depth);
  }
};

/// Draws a polygon into some rows. Of one that lies along the light (MapPolygon::facing) edges
/// alone are drawn.
/// @param texels where it is among the texels. Their margin is the same for all that is drawn:
/// walks from texel to edge must not lose an edge that is taken to be farther away
/// @param cells of those rows, `width` each
void drawPolygon(
  const MapPolygon& polygon, const PolygonOnTexels& texels, int width, Span rows, Cell* cells);

/// Notes how far off its plane a tracer may see a polygon that does not lie along the light and
/// begins before Cell::oneLayerUpTo(): when all edges and polygons are drawn. Others are behind the
/// receivers that are lit by that, wherever a tracer sees them.
void drawNoise(const PolygonOnTexels& texels, int width, Span rows, Cell* cells);

/// Asks `agrees` about each texel that a polygon touches, with bounds on its depth there, until it
/// does not agree.
/// @return whether it always did
bool allTexels(const MapPolygon& polygon, double margin, int width,
  const std::function<bool(int x, int y, float nearest, float farthest)>& agrees);

/// A triangle and those that go on across its edges: a part of the casters' surface, which covers
/// every texel that it meets but for those on its border.
struct MapRing
{
  std::vector<MapPolygon> triangles; ///< the first is in the middle; all of them cover
  std::vector<MapSegment> border;    ///< all edges but those that two of the triangles share
};

/// Notes where a ring covers, for texels that its middle touches.
void drawRing(const MapRing& ring, double margin, int width, Span rows, Cell* cells);

/// Notes where a part of the casters' surface ends: before its triangles are drawn, of which those
/// behind an end do not count for how far it climbs.
void drawEndOfPart(const MapSegment& segment, double margin, int width, Span rows, Cell* cells);

/// Draws an edge into some rows.
void drawSegment(const MapSegment& segment, double margin, int width, Span rows, Cell* cells);

} // namespace gnomon
