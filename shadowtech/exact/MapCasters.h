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

/// By what a map may conclude that casters cover all of a texel.
enum class Covering
{
  Triangle,  ///< one triangle contains it
  Ring,      ///< or: a triangle and those across its edges do
  Fan,       ///< or: a triangle and those around its corners do
  Silhouette ///< or, as of Ring: no end of a part of the casters' surface is there, so that it goes on everywhere
};

/// What is drawn into a conservative map, whoever draws it: the casters' triangles, their ends and
/// sharp edges, and the rings around triangles. All of it is made when it is asked for, from what
/// is looked at once: which way triangles face.
class MapCasters
{
public:
  /// Looks at all triangles.
  /// @param scene, edges must outlive this
  /// @param found told of each triangle that is there, from several threads
  MapCasters(const CasterScene& scene, const CasterEdges& edges, Covering covering,
    const std::function<void(const BandItem&, const MapPolygon&)>& found);

  /// Whether a caster is so near to the light that nothing is certain.
  bool blind() const { return this->blind_; }
  /// Of all texels: the largest that a caster asks for, but for those that spoil texels.
  double margin() const { return this->margin_; }
  Covering covering() const { return this->covering_; }

  const CasterPlacements& placements() const { return this->placements_; }
  /// How many edges a placement has.
  std::size_t edgeCount(const Placement& placement) const
  {
    return this->edges_.of(placement.surface).edges.size();
  }

  /// A triangle as the map sees it.
  MapPolygon polygon(const BandItem& triangle) const;
  /// An edge, where it is an end or sharp and lies on the map.
  /// @return whether it does
  bool segment(const BandItem& edge, MapSegment& result) const;
  /// The part of the casters' surface around a triangle.
  /// @param middle the triangle's own polygon
  MapRing ring(const BandItem& triangle, const MapPolygon& middle) const;

  ///@{
  /// The part of the casters' surface that a triangle or an edge belongs to; none where nobody asks
  /// for parts.
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
  std::vector<std::int8_t> facing_; ///< on the map, of all placements' triangles
};

/// Told of each cell when all is drawn, by its number on the map; from several threads.
using TakeCell = std::function<void(std::size_t texel, const Cell& cell)>;

} // namespace gnomon
