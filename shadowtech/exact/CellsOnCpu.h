#pragma once

#include "shadowtech/exact/TexelCells.h"
#include "shadowtech/mesh/CasterBands.h"
#include "shadowtech/mesh/CasterEdges.h"
#include "shadowtech/mesh/CasterShapes.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// The proof that casters cover all of a texel.
enum class Covering
{
  Triangle, ///< one triangle contains it
  Ring,     ///< or a triangle and those across its edges do
  Fan,      ///< or a triangle and those around its corners do
  /// As Ring; or no end of a part of the casters' surface is in the texel, so the part continues
  /// everywhere.
  Silhouette
};

/// The content of a conservative map: triangles of casters, ends and sharp edges, and rings around
/// triangles. Only the facing of triangles is computed up front.
class MapCasters
{
public:
  /// Find the facing of all triangles.
  /// @param scene, edges must outlive this
  /// @param found called with each triangle present in the view, from several threads
  MapCasters(const CasterScene& scene, const CasterEdges& edges, Covering covering,
    const std::function<void(const BandItem&, const MapPolygon&)>& found);

  /// True if a caster is so near to the light that nothing is certain.
  bool blind() const { return this->blind_; }
  /// Return the margin of all texels: the largest that a caster asks for. Casters that leave texels
  /// undecided do not count.
  double margin() const { return this->margin_; }
  Covering covering() const { return this->covering_; }

  const CasterPlacements& placements() const { return this->placements_; }
  /// Return how many edges a placement has.
  std::size_t edgeCount(const Placement& placement) const
  {
    return this->edges_.of(placement.surface).edges.size();
  }

  /// Return a triangle as the map sees it.
  MapPolygon polygon(const BandItem& triangle) const;
  /// Find an edge on the map.
  /// @return true if it is an end or sharp, and lies on the map
  bool segment(const BandItem& edge, MapSegment& result) const;
  /// Return the ring around a triangle.
  /// @param middle the triangle's own polygon
  MapRing ring(const BandItem& triangle, const MapPolygon& middle) const;

  ///@{
  /// Return the part of the casters' surface that a triangle or an edge belongs to; `noPart` unless
  /// the covering is Silhouette.
  CasterPart partOfTriangle(const BandItem& triangle) const;
  CasterPart partOfEdge(const BandItem& edge) const;
  ///@}

private:
  std::int8_t facingOf(const Placement& placement, std::uint32_t triangle) const;
  EdgeKind kindWithinSurface(const Placement& placement, const CasterEdge& edge) const;
  EdgeKind kindOf(const Placement& placement, std::uint32_t number) const;
  CasterPart partOf(const Placement& placement, std::uint32_t triangle) const;
  std::uint32_t across(
    const Placement& placement, const CasterEdge& edge, std::uint32_t triangle) const;
  std::vector<std::uint32_t> fanOf(const Placement& placement, std::uint32_t triangle) const;
  std::vector<std::uint32_t> edgeNeighboursOf(
    const Placement& placement, std::uint32_t triangle) const;

  const CasterScene& scene_;
  const CasterEdges& edges_;
  Covering covering_;
  bool blind_ = false;
  double margin_ = 0.0;
  CasterPlacements placements_;
  std::vector<std::int8_t> facing_; ///< on the map, for the triangles of all placements
};

/// Called with each finished cell and its number on the map, from several threads.
using TakeCell = std::function<void(std::size_t texel, const Cell& cell)>;

/// Bake a conservative map's cells on all cores of the CPU, in bands of rows.
/// @param size side of the map, in texels
/// @param take called with each finished cell
/// @return false if a caster is so near to the light that nothing is certain; `take` is not called
/// then
bool drawCellsOnCpu(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
  const TakeCell& take);

} // namespace gnomon
