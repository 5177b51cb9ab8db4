#pragma once

#include "shadowtech/exact/ConservativeMap.h"
#include "shadowtech/mesh/CasterShapes.h"
#include "shadowtech/mesh/TexelRows.h"

#include <array>
#include <cstddef>

namespace gnomon
{

/// @file
/// Conservative shadow maps by the letter of F. da Costa Morais, "Rasterization + Ray Tracing:
/// Rendering of Hard Shadows" (MSc thesis, Universidade do Minho, 2016), for those who want to see
/// how it differs from what is exact. docs/techniques/published.md says what they get wrong.
///
/// Only triangles that face away from the light cast. One layer holds them dilated, another one
/// eroded, by the same offset on all sides and with the depth of the triangle's plane at the
/// texel's centre. A receiver is lit where it is no deeper than both layers, in shadow where it is
/// deeper than both, else uncertain.

/// The offset in texels: half the diagonal of a square of `eta` texels (equation 19, in [-1, 1]
/// across the map).
constexpr double publishedOffset(double eta)
{
  return eta * 0.70710678118654752;
}

/// A side of a region of the map: nx x + ny y + c >= 0 inside it, in texels.
struct HalfPlane
{
  double nx, ny, c;
};

/// A convex region of the map. It has the texels whose centres lie in it.
struct TexelRegion
{
  std::size_t count = 0;
  std::array<HalfPlane, 2 * mostCorners> sides;
  double low = 0.0, high = 0.0; ///< between which rows it lies at most

  void add(const HalfPlane& side) { this->sides[this->count++] = side; }
  /// The texels of a row that it has.
  Span row(int y, int width) const;
};

/// A caster with its sides moved outwards, cut to its bounding box grown by half a texel (section
/// 2.2.1).
TexelRegion dilatedRegion(const MapPolygon& polygon, double offset);

/// Which sides of a triangle lead to another caster, so that they stay.
using SharedSides = std::array<bool, 3>;

/// A caster with its sides moved inwards but for those that it shares, and without its corners
/// between two of those (chapter 4). Nothing may be left of it.
///
/// A corner is cut by the line through the points where each of its sides meets the other one
/// moved: with u and w the unit vectors along them, away from the corner v, that line is (u + w).(p
/// - v) |u x w| = offset (1 + u.w).
TexelRegion erodedRegion(const MapPolygon& polygon, const SharedSides& shared, double offset);

/// Whose eroded layer a map has.
enum class PublishedLayers
{
  Crsm, ///< all sides of all triangles are moved
  Crsma ///< those between two casters stay
};

/// How they are drawn, for all lights and projections, although the text knows parallel rays on
/// uniform maps only: the same lines and planes in the plane of the map, where depth is affine on
/// planes. Surfaces with holes are in the dilated layer alone, and one-sided ones, which face the
/// light where they cast, in none. A map with a caster at the light itself is certain of nothing.
MapRule publishedRule(PublishedLayers layers);

/// TechniqueInfo::onlyCpuDraws of these.
constexpr const char* onlyCpuDrawsPublished =
  "maps by the letter of the publication are drawn by the CPU alone";

} // namespace gnomon
