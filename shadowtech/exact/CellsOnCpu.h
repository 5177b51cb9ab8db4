#pragma once

#include "shadowtech/exact/TexelCells.h"
#include "shadowtech/mesh/CasterBands.h"
#include "shadowtech/mesh/CasterEdges.h"
#include "shadowtech/mesh/CasterShapes.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>
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
    const std::function<void(const BandItem&, const MapPolygon&)>& found)
    : scene_(scene)
    , edges_(edges)
    , covering_(covering)
    , placements_(scene.occluders)
  {
    this->facing_.resize(this->placements_.triangleCount());
    std::atomic<bool> blind{ false };
    tbb::enumerable_thread_specific<double> margins(0.0);
    this->placements_.visitTriangles(
      [&](std::uint32_t number, std::uint32_t triangle)
      {
        const MapPolygon polygon = this->polygon({ number, triangle });
        this->facing_[this->placements_.numberOf(this->placements_[number], triangle)] =
          polygon.role.present ? static_cast<std::int8_t>(polygon.facing) : absentFacing;
        if (!polygon.role.present)
        {
          return;
        }
        // NaN must count as blind.
        if (!(polygon.margin < std::numeric_limits<double>::infinity()))
        {
          blind = true;
          return;
        }
        if (!polygon.role.poison)
        {
          double& margin = margins.local();
          margin = std::max(margin, polygon.margin);
        }
        found({ number, triangle }, polygon);
      });
    this->blind_ = blind;
    this->margin_ = margins.combine([](double a, double b) { return std::max(a, b); });
  }

  /// True if a caster is so near to the light that nothing is certain.
  bool blind() const { return this->blind_; }
  /// Return the margin of all texels: the largest that a caster asks for. Casters that leave texels
  /// undecided do not count.
  double margin() const { return this->margin_; }
  Covering covering() const { return this->covering_; }

  const CasterPlacements& placements() const { return this->placements_; }
  std::size_t edgeCount(const Placement& placement) const
  {
    return this->edges_.of(placement.surface).edges.size();
  }

  /// Return a triangle as the map sees it.
  MapPolygon polygon(const BandItem& triangle) const
  {
    const Placement& placement = this->placements_[triangle.placement];
    MapPolygon polygon = polygonOf(
      this->scene_, this->placements_.surfaceOf(placement), placement.instance, triangle.index);
    polygon.part = this->partOf(placement, triangle.index);
    return polygon;
  }

  /// Find an edge on the map.
  /// @return true if it is an end or sharp, and lies on the map
  bool segment(const BandItem& edge, MapSegment& result) const
  {
    const Placement& placement = this->placements_[edge.placement];
    const CasterEdge& found = this->edges_.of(placement.surface).edges[edge.index];
    if (this->facingOf(placement, found.triangles[0]) == absentFacing &&
      this->facingOf(placement, found.triangles[1]) == absentFacing)
    {
      return false;
    }
    const EdgeKind kind = this->kindOf(placement, found);
    result.part = this->partOf(placement, found.triangles[0]);
    return kind != EdgeKind::Inner &&
      segmentOf(this->scene_, this->placements_.surfaceOf(placement), placement.instance, found,
        kind, result);
  }

  /// Return the ring around a triangle.
  /// @param middle the triangle's own polygon
  MapRing ring(const BandItem& item, const MapPolygon& middle) const
  {
    const Placement& placement = this->placements_[item.placement];
    const std::uint32_t triangle = item.index;
    MapRing ring;
    const Surface& surface = this->placements_.surfaceOf(placement);
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    const std::vector<std::uint32_t> members = this->membersOf(placement, triangle);
    for (const std::uint32_t member : members)
    {
      ring.triangles.push_back(
        member == triangle ? middle : polygonOf(this->scene_, surface, placement.instance, member));
      for (const std::uint32_t number : edges.ofTriangle[member - surface.firstTriangle])
      {
        const CasterEdge& edge = edges.edges[number];
        const std::uint32_t other = this->across(placement, edge, member);
        MapSegment segment;
        if (std::find(members.begin(), members.end(), other) == members.end() &&
          segmentOf(this->scene_, surface, placement.instance, edge, EdgeKind::End, segment))
        {
          ring.border.push_back(segment);
        }
      }
    }
    return ring;
  }

  ///@{
  /// Return the part of the casters' surface that a triangle or an edge belongs to; `noPart` unless
  /// the covering is Silhouette.
  CasterPart partOfTriangle(const BandItem& triangle) const
  {
    return this->partOf(this->placements_[triangle.placement], triangle.index);
  }

  CasterPart partOfEdge(const BandItem& edge) const
  {
    const Placement& placement = this->placements_[edge.placement];
    return this->partOf(
      placement, this->edges_.of(placement.surface).edges[edge.index].triangles[0]);
  }

  ///@}

private:
  std::int8_t facingOf(const Placement& placement, std::uint32_t triangle) const
  {
    return triangle == CasterEdge::none
      ? absentFacing
      : this->facing_[this->placements_.numberOf(placement, triangle)];
  }

  EdgeKind kindOf(const Placement& placement, const CasterEdge& edge) const
  {
    return gnomon::kindOf(edge, this->facingOf(placement, edge.triangles[0]),
      this->facingOf(placement, edge.triangles[1]));
  }

  CasterPart partOf(const Placement& placement, std::uint32_t triangle) const
  {
    return this->covering_ == Covering::Silhouette
      ? CasterPart(placement.instance) << 32 | this->edges_.partOf(triangle)
      : noPart;
  }

  /// Return the triangle across an edge where the casters' surface continues; `none` where it ends.
  std::uint32_t across(
    const Placement& placement, const CasterEdge& edge, std::uint32_t triangle) const
  {
    const EdgeKind kind = this->kindOf(placement, edge);
    return kind == EdgeKind::Inner || kind == EdgeKind::Sharp ? edge.other(triangle)
                                                              : CasterEdge::none;
  }

  /// Return a triangle, followed by those that continue its surface across its edges, or around its
  /// corners.
  std::vector<std::uint32_t> membersOf(const Placement& placement, std::uint32_t triangle) const
  {
    constexpr std::size_t most = 40; // nearly all corners have fewer triangles around them
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    const std::uint32_t first = this->placements_.surfaceOf(placement).firstTriangle;
    const auto& own = edges.ofTriangle[triangle - first];
    const auto meetsCorner = [&](const CasterEdge& edge)
    {
      return std::any_of(own.begin(), own.end(),
        [&](std::uint32_t side)
        { return edge.meets(edges.edges[side].from) || edge.meets(edges.edges[side].to); });
    };
    std::vector<std::uint32_t> members{ triangle };
    for (std::size_t i = 0; i < (this->covering_ == Covering::Fan ? members.size() : 1); ++i)
    {
      const std::uint32_t member = members[i];
      for (const std::uint32_t side : edges.ofTriangle[member - first])
      {
        const CasterEdge& edge = edges.edges[side];
        const std::uint32_t other =
          meetsCorner(edge) ? this->across(placement, edge, member) : CasterEdge::none;
        if (other != CasterEdge::none && members.size() < most &&
          std::find(members.begin(), members.end(), other) == members.end())
        {
          members.push_back(other);
        }
      }
    }
    return members;
  }

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

/// The triangles of a band whose noise is still to be gathered.
struct DrawnTriangles
{
  /// Limit of `kept`, some 10 MB. Converting a triangle to texels takes as long as rasterizing it.
  static constexpr std::size_t mostKept = std::size_t(1) << 14;
  std::vector<PolygonOnTexels> kept;
  std::vector<BandItem> others;

  void add(const BandItem& item, const PolygonOnTexels& texels)
  {
    this->kept.size() < mostKept ? this->kept.push_back(texels) : this->others.push_back(item);
  }
};

/// A map in the making. Its constructor sorts triangles and edges into bands of rows.
class CellDrawing
{
public:
  CellDrawing(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering)
    : size_(size)
    , triangles_(size)
    , segments_(size)
    , casters_(scene, edges, covering,
        [this](const BandItem& triangle, const MapPolygon& polygon)
        {
          const double margin = std::max(polygon.margin, largestMargin);
          const auto [low, high] = polygon.rows();
          this->triangles_.add(low - margin, high + margin, triangle);
        })
  {
    if (!this->casters_.blind())
    {
      this->sortEdges();
    }
  }

  bool blind() const { return this->casters_.blind(); }

  void draw(const TakeCell& take) const
  {
    drawBands<Cell>(
      this->size_, [this](int band, Span rows, Cell* cells) { this->drawBand(band, rows, cells); },
      take);
  }

private:
  void sortEdges()
  {
    this->casters_.placements().visitAll([this](const Placement& placement)
      { return this->casters_.edgeCount(placement); },
      [&](std::uint32_t placement, std::uint32_t i)
      {
        MapSegment found;
        if (this->casters_.segment({ placement, i }, found))
        {
          const auto& [a, b] = found.ends;
          const double margin = this->casters_.margin() + thinTexels;
          this->segments_.add(
            std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin, { placement, i });
        }
      });
  }

  /// Rasterize ends first, as layers behind an end do not count for climb. Gather noise last, as
  /// triangles behind the one layer do not matter for how far off it rays must start.
  void drawBand(int band, Span rows, Cell* cells) const
  {
    this->segments_.visit(band,
      [&](const BandItem& item)
      {
        MapSegment found;
        if (this->casters_.segment(item, found))
        {
          drawSegment(found, this->casters_.margin(), this->size_, rows, cells);
        }
      });
    DrawnTriangles drawn;
    if (this->casters_.covering() == Covering::Silhouette)
    {
      this->drawParts(band, rows, cells, drawn);
    }
    else
    {
      this->triangles_.visit(
        band, [&](const BandItem& item) { this->drawTriangle(item, rows, cells, drawn); });
    }
    for (const PolygonOnTexels& texels : drawn.kept)
    {
      drawNoise(texels, this->size_, rows, cells);
    }
    for (const BandItem& item : drawn.others)
    {
      drawNoise(PolygonOnTexels(this->casters_.polygon(item), this->casters_.margin(), rows),
        this->size_, rows, cells);
    }
  }

  /// Rasterize the triangles of a band part by part, the ends of each part first.
  void drawParts(int band, Span rows, Cell* cells, DrawnTriangles& drawn) const
  {
    struct PartItem
    {
      CasterPart part;
      bool triangle; ///< false for an edge
      BandItem item;
    };
    std::vector<PartItem> items;
    this->segments_.visit(band,
      [&](const BandItem& item) {
        items.push_back({ this->casters_.partOfEdge(item), false, item });
      });
    this->triangles_.visit(band,
      [&](const BandItem& item) {
        items.push_back({ this->casters_.partOfTriangle(item), true, item });
      });
    std::sort(items.begin(), items.end(),
      [](const PartItem& a, const PartItem& b)
      { return std::tie(a.part, a.triangle) < std::tie(b.part, b.triangle); });
    for (const PartItem& item : items)
    {
      MapSegment found;
      if (item.triangle)
      {
        this->drawTriangle(item.item, rows, cells, drawn);
      }
      else if (this->casters_.segment(item.item, found) && found.isEnd)
      {
        drawEndOfPart(found, this->casters_.margin(), this->size_, rows, cells);
      }
    }
    std::for_each(cells,
      cells + static_cast<std::ptrdiff_t>(rows.last - rows.first + 1) * this->size_,
      [](Cell& cell) { cell.turnTo(noPart); });
  }

  void drawTriangle(const BandItem& item, Span rows, Cell* cells, DrawnTriangles& drawn) const
  {
    const MapPolygon polygon = this->casters_.polygon(item);
    const double margin = this->casters_.margin();
    const PolygonOnTexels texels(polygon, margin, rows);
    drawPolygon(polygon, texels, this->size_, rows, cells);
    if (polygon.facing != 0)
    {
      drawn.add(item, texels);
    }
    if (this->casters_.covering() != Covering::Triangle && polygon.role.covers)
    {
      drawRing(this->casters_.ring(item, polygon), margin, this->size_, rows, cells);
    }
  }

  int size_;
  CasterBands triangles_;
  CasterBands segments_;
  MapCasters casters_;
};

/// Bake a conservative map's cells on all cores of the CPU, in bands of rows.
/// @param size side of the map, in texels
/// @param take called with each finished cell
/// @return false if a caster is so near to the light that nothing is certain; `take` is not called
/// then
inline bool drawCellsOnCpu(const CasterScene& scene, const CasterEdges& edges, int size,
  Covering covering, const TakeCell& take)
{
  const CellDrawing drawing(scene, edges, size, covering);
  if (drawing.blind())
  {
    return false;
  }
  drawing.draw(take);
  return true;
}

} // namespace gnomon
