#pragma once

#include "shadowtech/exact/ConservativeMap.h"
#include "shadowtech/exact/ConservativeTechnique.h"
#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// @file
/// Conservative shadow maps exactly as published by F. da Costa Morais, "Rasterization + Ray
/// Tracing: Rendering of Hard Shadows" (MSc thesis, Universidade do Minho, 2016). They allow a
/// comparison with exact maps. docs/techniques/published.md lists their errors.
///
/// Only triangles that face away from the light cast. One layer holds them dilated, another eroded,
/// by the same offset on all sides. Both hold the depth of the triangle's plane at the texel's
/// centre. A receiver is lit if it is no deeper than both layers, in shadow if it is deeper than
/// both, else uncertain.

/// Return the offset in texels: half the diagonal of a square of `eta` texels (equation 19, in [-1,
/// 1] across the map).
constexpr double publishedOffset(double eta)
{
  return eta * 0.70710678118654752;
}

/// A side of a region of the map: nx x + ny y + c >= 0 inside it, in texels.
struct HalfPlane
{
  double nx, ny, c;
};

/// A convex region of the map. It holds the texels whose centres lie in it.
struct TexelRegion
{
  std::size_t count = 0;
  std::array<HalfPlane, 2 * mostCorners> sides;
  double low = 0.0, high = 0.0; ///< bounds of its rows

  void add(const HalfPlane& side) { this->sides[this->count++] = side; }
  Span row(int y, int width) const;
};

/// Return a caster with its sides moved outwards, clipped to its bounding box grown by half a texel
/// (section 2.2.1).
TexelRegion dilatedRegion(const MapPolygon& polygon, double offset);

/// For each side of a triangle, true if it leads to another caster, and so stays.
using SharedSides = std::array<bool, 3>;

/// Return a caster with all sides moved inwards that it does not share, and without corners between
/// two shared sides (chapter 4). It may be empty.
///
/// A corner is cut by the line through the points where each of its sides meets the other one
/// moved. Let u and w be the unit vectors along the sides, away from the corner v. The line is (u +
/// w).(p - v) |u x w| = offset (1 + u.w).
TexelRegion erodedRegion(const MapPolygon& polygon, const SharedSides& shared, double offset);

/// The technique whose eroded layer a map has.
enum class PublishedLayers
{
  Crsm, ///< moves all sides of all triangles
  Crsma ///< keeps sides between two casters
};

/// Return the rule that bakes published maps, for all lights and projections. The thesis only
/// covers parallel rays on uniform maps. Here the same lines and planes lie in the plane of the
/// map, where depth is affine on planes.
///
/// Surfaces with holes are in the dilated layer only. One-sided surfaces are in neither, as they
/// face the light where they cast. A map with a caster at the light itself decides nothing.
MapRule publishedRule(PublishedLayers layers);

/// Return `crsm` and `crsma` exactly as published (Morais 2016, chapter 4). They are not exact
/// (PublishedMap.h).
const std::vector<ConservativeEntry>& publishedCrsm();

} // namespace gnomon
