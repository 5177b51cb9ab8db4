#include "shadowtech/conservative/ConservativeMap.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/conservative/CasterBands.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/TexelCells.h"

#include <glm/gtc/matrix_access.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace gnomon
{
namespace
{

/// Rounding of depths to float, and of what is computed with them.
constexpr float depthRounding = 4.76837158e-7f; // 2^-21

/// Depths that are less, or more, whatever was rounded.
float below(float depth)
{
  return std::isfinite(depth) ? depth - depthRounding * (1.0f + std::abs(depth)) : depth;
}
float above(float depth)
{
  return std::isfinite(depth) ? depth + depthRounding * (1.0f + std::abs(depth)) : depth;
}

/// How many triangles around a corner are followed, to either side: more than there mostly are.
constexpr int mostAroundCorner = 12;

/// What follows from a cell, when all is drawn.
TexelBounds boundsOf(const Cell& cell)
{
  TexelBounds bounds;
  bounds.litUpTo = below(cell.nearest);
  // One layer alone reaches up to here: that of the receiver.
  const float second = below(std::min(cell.second, cell.sharpEnd) - cell.climb);
  bounds.litUpToOnCasters = std::max(bounds.litUpTo, second);
  bounds.leastOffsetOnCasters = cell.noise / static_cast<float>(sharpCosine);
  bounds.shadowFrom = above(std::min(cell.contained, cell.covered));
  return bounds;
}

/// What holds of all of no texels, to begin with.
constexpr TexelBounds everyTexel{ std::numeric_limits<float>::infinity(),
  std::numeric_limits<float>::infinity(), 0.0f, -std::numeric_limits<float>::infinity() };

/// What is true of both.
TexelBounds bothOf(const TexelBounds& a, const TexelBounds& b)
{
  return { std::min(a.litUpTo, b.litUpTo), std::min(a.litUpToOnCasters, b.litUpToOnCasters),
    std::max(a.leastOffsetOnCasters, b.leastOffsetOnCasters),
    std::max(a.shadowFrom, b.shadowFrom) };
}

/// A map while it is drawn: first which rows each triangle and edge lies in, then the rows, band by band.
class MapDrawing
{
public:
  MapDrawing(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering)
    : scene_(scene)
    , edges_(edges)
    , covering_(covering)
    , size_(size)
    , placements_(scene.occluders)
    , triangles_(size)
    , segments_(size)
  {
    this->sortTriangles();
    if (!this->blind_)
    {
      this->sortEdges();
    }
  }

  /// Whether a caster is so near to the light that nothing is certain.
  bool blind() const { return this->blind_; }

  /// Draws all bands.
  /// @param take called with each cell's number on the map and the cell, from several threads
  template <typename Take>
  void draw(const Take& take)
  {
    drawBands<Cell>(
      this->size_, [this](int band, Span rows, Cell* cells) { this->drawBand(band, rows, cells); },
      take);
  }

private:
  void sortTriangles()
  {
    this->facing_.resize(this->placements_.triangleCount());
    std::atomic<bool> blind{ false };
    tbb::enumerable_thread_specific<double> margins(0.0);
    this->placements_.visitTriangles(
      [&](std::uint32_t number, std::uint32_t triangle)
      {
        const Placement& placement = this->placements_[number];
        const Surface& surface = this->placements_.surfaceOf(placement);
        const MapPolygon polygon = polygonOf(this->scene_, surface, placement.instance, triangle);
        this->facing_[this->placements_.numberOf(placement, triangle)] =
          polygon.role.present ? static_cast<std::int8_t>(polygon.facing) : absentFacing;
        if (!polygon.role.present)
        {
          return;
        }
        // Written so that NaN is blind.
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
        const double margin = std::max(polygon.margin, largestMargin);
        const auto [low, high] = polygon.rows();
        this->triangles_.add(low - margin, high + margin, { number, triangle });
      });
    this->blind_ = blind;
    for (const double margin : margins)
    {
      this->margin_ = std::max(this->margin_, margin);
    }
  }

  std::int8_t facingOf(const Placement& placement, std::uint32_t triangle) const
  {
    return triangle == CasterEdge::none
      ? absentFacing
      : this->facing_[this->placements_.numberOf(placement, triangle)];
  }

  EdgeKind kindWithinSurface(const Placement& placement, const CasterEdge& edge) const
  {
    return gnomon::kindOf(edge, this->facingOf(placement, edge.triangles[0]),
      this->facingOf(placement, edge.triangles[1]));
  }

  /// The same of an edge by its number, at which the surface may go on as another one.
  EdgeKind kindOf(const Placement& placement, std::uint32_t number) const
  {
    CasterEdge edge = this->edges_.of(placement.surface).edges[number];
    const Seam* const seam = edge.triangles[1] == CasterEdge::none
      ? this->edges_.seams().at(placement.surface, number)
      : nullptr;
    if (!seam)
    {
      return this->kindWithinSurface(placement, edge);
    }
    edge.sameDirection = seam->sameDirection;
    edge.sharp = seam->sharp;
    return gnomon::kindOf(edge, this->facingOf(placement, edge.triangles[0]),
      this->facingOf(this->placements_.placementOf(seam->otherSurface), seam->otherTriangle));
  }

  /// The part of the casters' surface that a triangle belongs to; none where nobody asks for parts.
  CasterPart partOf(const Placement& placement, std::uint32_t triangle) const
  {
    return this->covering_ == Covering::Silhouette
      ? CasterPart(placement.instance) << 32 | this->edges_.partOf(triangle)
      : noPart;
  }

  bool segment(const Placement& placement, std::uint32_t number, MapSegment& result) const
  {
    const CasterEdge& edge = this->edges_.of(placement.surface).edges[number];
    if (this->facingOf(placement, edge.triangles[0]) == absentFacing &&
      this->facingOf(placement, edge.triangles[1]) == absentFacing)
    {
      return false;
    }
    const EdgeKind kind = this->kindOf(placement, number);
    result.part = this->partOf(placement, edge.triangles[0]);
    return kind != EdgeKind::Inner &&
      segmentOf(this->scene_, this->placements_.surfaceOf(placement), placement.instance, edge,
        kind, result);
  }

  /// A triangle as the map sees it.
  MapPolygon polygon(const Placement& placement, std::uint32_t triangle) const
  {
    MapPolygon polygon =
      polygonOf(this->scene_, this->placements_.surfaceOf(placement), placement.instance, triangle);
    polygon.part = this->partOf(placement, triangle);
    return polygon;
  }

  /// The triangle on which the casters' surface goes on across an edge; `none` where it ends.
  std::uint32_t across(
    const Placement& placement, const CasterEdge& edge, std::uint32_t triangle) const
  {
    const EdgeKind kind = this->kindWithinSurface(placement, edge);
    return kind == EdgeKind::Inner || kind == EdgeKind::Sharp ? edge.other(triangle)
                                                              : CasterEdge::none;
  }

  /// A triangle, the first, and those to which its surface goes on around its corners.
  std::vector<std::uint32_t> fanOf(const Placement& placement, std::uint32_t triangle) const
  {
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    const std::uint32_t first = this->placements_.surfaceOf(placement).firstTriangle;
    std::vector<std::uint32_t> fan{ triangle };
    // Around the corner that two sides share, beginning with one of them.
    const auto walk = [&](std::uint32_t side, std::uint32_t otherSide)
    {
      const CasterEdge& start = edges.edges[side];
      const bool atFrom = edges.edges[otherSide].meets(start.from);
      const std::uint32_t corner = atFrom ? start.from : start.to;
      std::uint32_t current = triangle;
      for (int i = 0; i < mostAroundCorner; ++i)
      {
        current = this->across(placement, edges.edges[side], current);
        if (current == CasterEdge::none || current == triangle)
        {
          return;
        }
        if (std::find(fan.begin(), fan.end(), current) == fan.end())
        {
          fan.push_back(current);
        }
        const auto& sides = edges.ofTriangle[current - first];
        side = *std::find_if(sides.begin(), sides.end(),
          [&](std::uint32_t next) { return next != side && edges.edges[next].meets(corner); });
      }
    };
    const auto& sides = edges.ofTriangle[triangle - first];
    for (std::size_t k = 0; k < 3; ++k)
    {
      walk(sides[k], sides[(k + 1) % 3]);
      walk(sides[k], sides[(k + 2) % 3]);
    }
    return fan;
  }

  /// A triangle, the first, and those to which its surface goes on across its edges.
  std::vector<std::uint32_t> edgeNeighboursOf(
    const Placement& placement, std::uint32_t triangle) const
  {
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    std::vector<std::uint32_t> ring{ triangle };
    for (const std::uint32_t side :
      edges.ofTriangle[triangle - this->placements_.surfaceOf(placement).firstTriangle])
    {
      const std::uint32_t other = this->across(placement, edges.edges[side], triangle);
      if (other != CasterEdge::none)
      {
        ring.push_back(other);
      }
    }
    return ring;
  }

  /// The part of the casters' surface around a triangle. Without covering triangles nothing.
  MapRing ringOf(const Placement& placement, std::uint32_t triangle, const MapPolygon& middle) const
  {
    MapRing ring;
    const Surface& surface = this->placements_.surfaceOf(placement);
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    const std::vector<std::uint32_t> members = this->covering_ == Covering::Fan
      ? this->fanOf(placement, triangle)
      : this->edgeNeighboursOf(placement, triangle);
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

  void sortEdges()
  {
    const auto countOf = [this](const Placement& placement)
    { return this->edges_.of(placement.surface).edges.size(); };
    this->placements_.visitAll(countOf,
      [&](std::uint32_t number, std::uint32_t i)
      {
        MapSegment found;
        if (this->segment(this->placements_[number], i, found))
        {
          const auto& [a, b] = found.ends;
          const double margin = this->margin_ + thinTexels;
          this->segments_.add(
            std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin, { number, i });
        }
      });
  }

  /// Ends first: what lies behind one does not matter for how far the layers before it climb.
  void drawBand(int band, Span rows, Cell* cells) const
  {
    this->segments_.visit(band,
      [&](const BandItem& item)
      {
        MapSegment found;
        if (this->segment(this->placements_[item.placement], item.index, found))
        {
          drawSegment(found, this->margin_, this->size_, rows, cells);
        }
      });
    if (this->covering_ == Covering::Silhouette)
    {
      this->drawParts(band, rows, cells);
      return;
    }
    this->triangles_.visit(
      band, [&](const BandItem& item) { this->drawTriangle(item, rows, cells); });
  }

  /// Draws the triangles of a band part by part, of each its ends first.
  void drawParts(int band, Span rows, Cell* cells) const
  {
    struct PartItem
    {
      CasterPart part;
      bool triangle; ///< else an edge
      BandItem item;
    };
    std::vector<PartItem> items;
    this->segments_.visit(band,
      [&](const BandItem& item)
      {
        const Placement& placement = this->placements_[item.placement];
        const CasterEdge& edge = this->edges_.of(placement.surface).edges[item.index];
        items.push_back({ this->partOf(placement, edge.triangles[0]), false, item });
      });
    this->triangles_.visit(band,
      [&](const BandItem& item)
      {
        const Placement& placement = this->placements_[item.placement];
        items.push_back({ this->partOf(placement, item.index), true, item });
      });
    std::sort(items.begin(), items.end(),
      [](const PartItem& a, const PartItem& b)
      { return std::tie(a.part, a.triangle) < std::tie(b.part, b.triangle); });
    for (const PartItem& item : items)
    {
      MapSegment found;
      if (item.triangle)
      {
        this->drawTriangle(item.item, rows, cells);
      }
      else if (this->segment(this->placements_[item.item.placement], item.item.index, found) &&
        found.isEnd)
      {
        drawEndOfPart(found, this->margin_, this->size_, rows, cells);
      }
    }
    std::for_each(cells,
      cells + static_cast<std::ptrdiff_t>(rows.last - rows.first + 1) * this->size_,
      [](Cell& cell) { cell.turnTo(noPart); });
  }

  void drawTriangle(const BandItem& item, Span rows, Cell* cells) const
  {
    const Placement& placement = this->placements_[item.placement];
    const MapPolygon polygon = this->polygon(placement, item.index);
    drawPolygon(polygon, this->margin_, this->size_, rows, cells);
    if (this->covering_ != Covering::Triangle && polygon.role.covers)
    {
      drawRing(
        this->ringOf(placement, item.index, polygon), this->margin_, this->size_, rows, cells);
    }
  }

  const CasterScene& scene_;
  const CasterEdges& edges_;
  Covering covering_;
  int size_;
  bool blind_ = false;
  double margin_ = 0.0; ///< of all texels: the largest that a caster asks for, but for poison
  CasterPlacements placements_;
  std::vector<std::int8_t> facing_; ///< on the map, of all placements' triangles
  CasterBands triangles_;
  CasterBands segments_;
};

/// A few receivers as a map sees them.
struct Looks
{
  static constexpr std::size_t most = 256;
  std::array<int, most> texel; ///< -1 where the map cannot say anything
  ///@{
  /// What the depth is where the shadow ray starts, at most and at least.
  std::array<float, most> farthest;
  std::array<float, most> nearest;
  ///@}
};

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void lookAt(
  const LookUp& map, const ReceiverPixels& receivers, std::size_t first, int count, Looks& looks)
{
  const float* const positionX = &receivers.positionX[first];
  const float* const positionY = &receivers.positionY[first];
  const float* const positionZ = &receivers.positionZ[first];
  const float* const offset = &receivers.offset[first];
  const auto size = static_cast<float>(map.size);
  const glm::mat4& m = map.mapFromCentred;
  const glm::vec4 along = map.distance;
  int* const texel = looks.texel.data();
  float* const farthest = looks.farthest.data();
  float* const nearest = looks.nearest.data();
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
  {
    const float px = positionX[i], py = positionY[i], pz = positionZ[i];
    const float w = m[0].w * px + m[1].w * py + m[2].w * pz + m[3].w;
    const float perW = 1.0f / w;
    const float x = (m[0].x * px + m[1].x * py + m[2].x * pz + m[3].x) * perW;
    const float y = (m[0].y * px + m[1].y * py + m[2].y * pz + m[3].y) * perW;
    const float depth = (m[0].z * px + m[1].z * py + m[2].z * pz + m[3].z) * perW;
    const float distance = along.x * px + along.y * py + along.z * pz + along.w;
    // Written so that NaN fails. A shadow ray may start no farther beside its receiver than margins say.
    const bool holds = (w > 0.0f) & (distance > 0.0f) & (x >= 0.0f) & (y >= 0.0f) & (x < size) &
      (y < size) & (offset[i] <= map.largestOffset * distance);
    const int column = static_cast<int>(holds ? x : 0.0f);
    const int row = static_cast<int>(holds ? y : 0.0f);
    texel[i] = holds ? row * map.size + column : -1;
    const float perUnit = (map.depthPerUnit.x + map.depthPerUnit.y * perW) * perW;
    const float moved = (map.rounding + offset[i]) * perUnit;
    farthest[i] = depth + moved;
    nearest[i] = depth - moved;
  }
}

} // namespace

//------------------------------------------------------------------------------
LookUp lookUpOf(const CasterScene& scene, const LightView& view)
{
  LookUp lookUp;
  lookUp.mapFromCentred = glm::mat4(scene.space.mapFromCentred());
  if (scene.space.positional)
  {
    lookUp.distance = glm::vec4(glm::row(view.rays.viewFromCentred, 2));
  }
  lookUp.size = static_cast<int>(scene.space.size);
  return lookUp;
}

//------------------------------------------------------------------------------
MapRule certainRule(Covering covering)
{
  return [covering](const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders,
           const CasterEdges& edges)
  {
    const CasterScene scene = casterScene(view, hasBox, sizeTexels, occluders);
    LookUp lookUp = lookUpOf(scene, view);
    lookUp.depthPerUnit = glm::vec2(scene.space.depthPerUnit());
    lookUp.rounding = static_cast<float>(scene.lateral);
    lookUp.largestOffset = static_cast<float>(scene.largestOffset(1.0));
    MapDrawing drawing(scene, edges, sizeTexels, covering);
    std::vector<TexelBounds> texels;
    if (!drawing.blind())
    {
      texels.resize(static_cast<std::size_t>(sizeTexels) * static_cast<std::size_t>(sizeTexels));
      drawing.draw([&](std::size_t i, const Cell& cell) { texels[i] = boundsOf(cell); });
    }
    return ConservativeMap(view, hasBox, lookUp, std::move(texels));
  };
}

//------------------------------------------------------------------------------
ConservativeMap::ConservativeMap(
  const LightView& view, bool hasBox, const LookUp& lookUp, std::vector<TexelBounds> texels)
  : view_(view)
  , hasBox_(hasBox)
  , lookUp_(lookUp)
  , texels_(std::move(texels))
{
  if (!this->texels_.empty())
  {
    this->buildLevels();
  }
}

//------------------------------------------------------------------------------
void ConservativeMap::buildLevels()
{
  const std::vector<TexelBounds>* finer = &this->texels_;
  // Lines are one tile long: they need no coarser level than that of a few texels for the whole map.
  for (int size = this->lookUp_.size; size > 8;)
  {
    const int half = (size + 1) / 2;
    std::vector<TexelBounds> level(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    tbb::parallel_for(0, half,
      [&](int y)
      {
        for (int x = 0; x < half; ++x)
        {
          TexelBounds& bounds = level[static_cast<std::size_t>(y) * static_cast<std::size_t>(half) +
            static_cast<std::size_t>(x)];
          bounds = everyTexel;
          for (int i = 0; i < 4; ++i)
          {
            const int column = std::min(2 * x + (i & 1), size - 1);
            const int row = std::min(2 * y + (i >> 1), size - 1);
            bounds = bothOf(bounds,
              (*finer)[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                static_cast<std::size_t>(column)]);
          }
        }
      });
    this->levels_.push_back(std::move(level));
    finer = &this->levels_.back();
    size = half;
  }
}

//------------------------------------------------------------------------------
CasterScene ConservativeMap::sceneOf(const Occluders& occluders) const
{
  return casterScene(this->view_, this->hasBox_, this->lookUp_.size, occluders);
}

//------------------------------------------------------------------------------
Certainty ConservativeMap::ask(const CasterScene& scene, const MapPolygon& triangle,
  double leastOffset, double mostOffset, bool onCaster) const
{
  // Larger triangles are seldom all lit or all in shadow, and their pixels are many, so that it costs little to ask for
  // each.
  constexpr double mostTexels = 4096.0;
  if (this->texels_.empty() || triangle.facing == 0 ||
    mostOffset > scene.largestOffset(triangle.nearestZ))
  {
    return Certainty::Uncertain;
  }
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < triangle.count; ++i)
  {
    const glm::dvec2 corner(triangle.corners[i].x, triangle.corners[i].y);
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const double size = this->lookUp_.size;
  const glm::dvec2 extent = high - low + 1.0;
  // Written so that NaN fails.
  if (!(low.x >= 0.0 && low.y >= 0.0 && high.x < size && high.y < size &&
        extent.x * extent.y <= mostTexels))
  {
    return Certainty::Uncertain;
  }
  const auto moved = static_cast<float>((scene.lateral + mostOffset) * triangle.depthPerUnit);
  bool lit = true;
  bool shadow = true;
  const auto agrees = [&](int x, int y, float nearest, float farthest)
  {
    const TexelBounds& texel =
      this->texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->lookUp_.size) +
        static_cast<std::size_t>(x)];
    lit &= farthest + moved <= texel.litUpToOf(onCaster, leastOffset);
    shadow &= nearest - moved > texel.shadowFrom;
    return lit || shadow;
  };
  return !allTexels(triangle, triangle.margin, this->lookUp_.size, agrees) ? Certainty::Uncertain
    : lit                                                                  ? Certainty::Lit
                                                                           : Certainty::Shadow;
}

//------------------------------------------------------------------------------
Certainty ConservativeMap::ask(const ReceiverSegment& segment, bool onCaster) const
{
  if (this->texels_.empty())
  {
    return Certainty::Uncertain;
  }
  // As lookAt(), at both ends: place, depth and distance of all between them are between theirs.
  const glm::dmat4 mapFromCentred(this->lookUp_.mapFromCentred);
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-std::numeric_limits<double>::infinity());
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  double perUnit = 0.0;
  for (const glm::dvec3& end : { segment.firstCentred, segment.lastCentred })
  {
    const glm::dvec4 map = mapFromCentred * glm::dvec4(end, 1.0);
    const double distance = glm::dot(glm::dvec4(this->lookUp_.distance), glm::dvec4(end, 1.0));
    const double perW = 1.0 / map.w;
    // Written so that NaN fails.
    if (!(map.w > 0.0 && distance > 0.0 &&
          segment.mostOffset <= this->lookUp_.largestOffset * distance * (1.0 - 1e-6)))
    {
      return Certainty::Uncertain;
    }
    const glm::dvec2 place(map.x * perW, map.y * perW);
    low = glm::min(low, place);
    high = glm::max(high, place);
    nearest = std::min(nearest, map.z * perW);
    farthest = std::max(farthest, map.z * perW);
    perUnit = std::max(
      perUnit, (this->lookUp_.depthPerUnit.x + this->lookUp_.depthPerUnit.y * perW) * perW);
  }
  int size = this->lookUp_.size;
  if (!(low.x >= 0.0 && low.y >= 0.0 && high.x < size && high.y < size))
  {
    return Certainty::Uncertain;
  }
  const double moved = (this->lookUp_.rounding + segment.mostOffset) * perUnit;
  nearest -= moved;
  farthest += moved;
  // Of a level whose texels are so large that there are few.
  glm::ivec2 first(low), last(high);
  const std::vector<TexelBounds>* texels = &this->texels_;
  for (std::size_t level = 0;
       level < this->levels_.size() && glm::max(last.x - first.x, last.y - first.y) > 3; ++level)
  {
    first /= 2;
    last /= 2;
    size = (size + 1) / 2;
    texels = &this->levels_[level];
  }
  bool lit = true;
  bool shadow = true;
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      const TexelBounds& texel =
        (*texels)[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
          static_cast<std::size_t>(x)];
      lit &= farthest <= texel.litUpToOf(onCaster, segment.leastOffset);
      shadow &= nearest > texel.shadowFrom;
      if (!lit && !shadow)
      {
        return Certainty::Uncertain;
      }
    }
  }
  return lit ? Certainty::Lit : Certainty::Shadow;
}

//------------------------------------------------------------------------------
void ConservativeMap::ask(const ReceiverPixels& receivers,
  const std::vector<std::uint8_t>& onCaster, std::vector<Certainty>& certain) const
{
  if (this->texels_.empty())
  {
    return;
  }
  Looks looks;
  for (std::size_t from = 0; from < receivers.size(); from += Looks::most)
  {
    const std::size_t part = std::min(Looks::most, receivers.size() - from);
    if (std::all_of(&receivers.surface[from], &receivers.surface[from] + part,
          [](std::uint32_t surface) { return surface == ReceiverPixels::notCovered; }))
    {
      continue;
    }
    lookAt(this->lookUp_, receivers, from, static_cast<int>(part), looks);
    for (std::size_t i = 0; i < part; ++i)
    {
      if (looks.texel[i] < 0 || certain[from + i] != Certainty::Uncertain)
      {
        continue;
      }
      const TexelBounds& texel = this->texels_[static_cast<std::size_t>(looks.texel[i])];
      const bool lit =
        looks.farthest[i] <= texel.litUpToOf(onCaster[receivers.surface[from + i] + 1u] != 0,
                               receivers.offset[from + i]);
      const bool shadow = looks.nearest[i] > texel.shadowFrom;
      certain[from + i] = lit ? Certainty::Lit : shadow ? Certainty::Shadow : Certainty::Uncertain;
    }
  }
}

//------------------------------------------------------------------------------
std::size_t ConservativeMap::bytes() const
{
  std::size_t bytes = bytesOf(this->texels_);
  for (const std::vector<TexelBounds>& level : this->levels_)
  {
    bytes += bytesOf(level);
  }
  return bytes;
}

} // namespace gnomon
