#include "shadowtech/published/PublishedMap.h"

#include "shadowtech/mesh/CasterBands.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon
{

namespace
{

/// Area in square texels below which casters count as edge-on, and are left out.
constexpr double edgeOnArea = 5e-7;

/// A side of a polygon with a positive length.
struct Edge
{
  MapCorner from;
  double ux, uy; ///< unit vector along it
  std::uint8_t side;
};

struct Edges
{
  std::size_t count = 0;
  std::array<Edge, mostCorners> edges;
};

/// Return the sides of a polygon, with its inside to their left.
Edges edgesOf(const MapPolygon& polygon)
{
  const bool turned = planeOf(polygon).area < 0.0;
  Edges result;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    const std::size_t first = turned ? polygon.count - i : i;
    const std::size_t at = first % polygon.count;
    const std::size_t next = (turned ? at + polygon.count - 1 : at + 1) % polygon.count;
    const MapCorner& a = polygon.corners[at];
    const MapCorner& b = polygon.corners[next];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length > 1e-9) // clipping may make corners coincide
    {
      result.edges[result.count++] = { a, (b.x - a.x) / length, (b.y - a.y) / length,
        polygon.sides[turned ? next : at] };
    }
  }
  return result;
}

/// Return the half plane to the left of an edge.
/// @param inwards how far it is moved to the left, in texels
HalfPlane leftOf(const Edge& edge, double inwards)
{
  const double nx = -edge.uy, ny = edge.ux;
  return { nx, ny, -(nx * edge.from.x + ny * edge.from.y) - inwards };
}

/// Return the half plane that cuts off the corner between two edges that stay.
HalfPlane withoutCorner(const Edge& in, const Edge& out, double offset)
{
  const double cosine = -(in.ux * out.ux + in.uy * out.uy); // of the corner's angle
  const double sine = std::abs(in.ux * out.uy - in.uy * out.ux);
  const double nx = sine * (out.ux - in.ux), ny = sine * (out.uy - in.uy);
  return { nx, ny, -(nx * out.from.x + ny * out.from.y) - offset * (1.0 + cosine) };
}

struct Layers
{
  float dilated = std::numeric_limits<float>::infinity();
  float eroded = std::numeric_limits<float>::infinity();
};

/// Write the depth of a caster's plane to the texels whose centres lie in a region.
void drawRegion(const TexelRegion& region, const MapPlane& plane, float Layers::*layer, int width,
  Span rows, Layers* cells)
{
  const Span inside = spanOf(region.low, region.high, rows.last + 1);
  for (int y = std::max(rows.first, inside.first); y <= inside.last; ++y)
  {
    Layers* const row = cells + static_cast<std::ptrdiff_t>(y - rows.first) * width;
    const Span span = region.row(y, width);
    for (int x = span.first; x <= span.last; ++x)
    {
      row[x].*layer = std::min(row[x].*layer, static_cast<float>(plane.depthAt(x + 0.5, y + 0.5)));
    }
  }
}

/// A published map being baked.
class PublishedDrawing
{
public:
  PublishedDrawing(const CasterScene& scene, const CasterEdges& edges, PublishedLayers layers)
    : scene_(scene)
    , edges_(edges)
    , layers_(layers)
    , size_(static_cast<int>(scene.space.size))
    , placements_(scene.occluders)
    , casters_(this->placements_.triangleCount(), 0)
    , bands_(this->size_)
  {
    // If the view's z grows away from the light, triangles that face away have the same winding on
    // the map as in their own plane.
    const double handedness = glm::determinant(glm::dmat3(scene.space.viewFromCentred));
    std::atomic<bool> blind{ false };
    this->placements_.visitTriangles(
      [&](std::uint32_t number, std::uint32_t triangle)
      {
        const MapPolygon polygon = this->polygon({ number, triangle });
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
        const double area = planeOf(polygon).area;
        if (std::abs(area) > edgeOnArea && area * handedness > 0.0)
        {
          this->casters_[this->placements_.numberOf(this->placements_[number], triangle)] = 1;
          const auto [low, high] = polygon.rows();
          this->bands_.add(low - 0.5, high + 0.5, { number, triangle });
        }
      });
    this->blind_ = blind;
  }

  /// True if a caster is so near to the light that nothing is certain.
  bool blind() const { return this->blind_; }

  /// Rasterize all bands.
  /// @param take called with each texel's number on the map and its layers, from several threads
  template <typename Take>
  void draw(const Take& take) const
  {
    drawBands<Layers>(
      this->size_,
      [this](int band, Span rows, Layers* cells) {
        this->bands_.visit(
          band, [&](const BandItem& item) { this->drawCaster(item, rows, cells); });
      },
      take);
  }

private:
  const Surface& surfaceOf(const BandItem& item) const
  {
    return this->placements_.surfaceOf(this->placements_[item.placement]);
  }

  MapPolygon polygon(const BandItem& item) const
  {
    return polygonOf(
      this->scene_, this->surfaceOf(item), this->placements_[item.placement].instance, item.index);
  }

  void drawCaster(const BandItem& item, Span rows, Layers* cells) const
  {
    const double offset = publishedOffset(1.0);
    const MapPolygon polygon = this->polygon(item);
    const MapPlane plane = planeOf(polygon);
    drawRegion(dilatedRegion(polygon, offset), plane, &Layers::dilated, this->size_, rows, cells);
    if (!this->surfaceOf(item).cutout)
    {
      drawRegion(erodedRegion(polygon, this->shared(item), offset), plane, &Layers::eroded,
        this->size_, rows, cells);
    }
  }

  /// A side whose neighbour is missing or faces the light is not shared (section 4).
  SharedSides shared(const BandItem& item) const
  {
    SharedSides result{ { false, false, false } };
    if (this->layers_ == PublishedLayers::Crsm)
    {
      return result;
    }
    const Placement& placement = this->placements_[item.placement];
    const SurfaceEdges& edges = this->edges_.of(placement.surface);
    const auto& sides = edges.ofTriangle[item.index - this->surfaceOf(item).firstTriangle];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint32_t other = edges.edges[sides[k]].other(item.index);
      result[k] = other != CasterEdge::none &&
        this->casters_[this->placements_.numberOf(placement, other)] != 0;
    }
    return result;
  }

  const CasterScene& scene_;
  const CasterEdges& edges_;
  PublishedLayers layers_;
  int size_;
  bool blind_ = false;
  CasterPlacements placements_;
  std::vector<std::uint8_t> casters_; ///< for the triangles of all placements, 1 if they face away
  CasterBands bands_;
};

TechniqueInfo infoOfPublished(const std::string& name)
{
  TechniqueInfo info = infoOfExact(name);
  info.settings = { &viewSettings(), &publishedSettings() };
  info.asPublished = name;
  info.exact = false;
  info.mapIsOptional = false;
  return info;
}

} // namespace

Span TexelRegion::row(int y, int width) const
{
  RowRange range{ -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
  for (std::size_t i = 0; i < this->count; ++i)
  {
    const HalfPlane& side = this->sides[i];
    range.cut(boundPerRest(side.nx), side.ny * (y + 0.5) + side.c);
  }
  return range.texels(0.5, width);
}

TexelRegion dilatedRegion(const MapPolygon& polygon, double offset)
{
  TexelRegion region;
  const Edges edges = edgesOf(polygon);
  double left = polygon.corners[0].x;
  double right = left;
  for (std::size_t i = 0; i < edges.count; ++i)
  {
    region.add(leftOf(edges.edges[i], -offset));
    left = std::min(left, edges.edges[i].from.x);
    right = std::max(right, edges.edges[i].from.x);
  }
  const auto [low, high] = polygon.rows();
  region.low = low - 0.5;
  region.high = high + 0.5;
  region.add({ 1.0, 0.0, 0.5 - left });
  region.add({ -1.0, 0.0, 0.5 + right });
  region.add({ 0.0, 1.0, -region.low });
  region.add({ 0.0, -1.0, region.high });
  return region;
}

TexelRegion erodedRegion(const MapPolygon& polygon, const SharedSides& shared, double offset)
{
  const auto stays = [&](const Edge& edge) { return edge.side != noSide && shared[edge.side]; };
  TexelRegion region;
  const Edges edges = edgesOf(polygon);
  for (std::size_t i = 0; i < edges.count; ++i)
  {
    const Edge& in = edges.edges[(i + edges.count - 1) % edges.count];
    const Edge& out = edges.edges[i];
    region.add(leftOf(out, stays(out) ? 0.0 : offset));
    if (stays(in) && stays(out))
    {
      region.add(withoutCorner(in, out, offset));
    }
  }
  std::tie(region.low, region.high) = polygon.rows();
  return region;
}

MapRule publishedRule(PublishedLayers layers)
{
  return [layers](const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders,
           const CasterEdges& edges)
  {
    const CasterScene scene = casterScene(view, hasBox, sizeTexels, occluders);
    const PublishedDrawing drawing(scene, edges, layers);
    std::vector<TexelBounds> texels;
    if (!drawing.blind())
    {
      texels.resize(static_cast<std::size_t>(sizeTexels) * static_cast<std::size_t>(sizeTexels));
      drawing.draw(
        [&](std::size_t i, const Layers& cell) {
          texels[i] = { cell.dilated, cell.dilated, 0.0f, cell.eroded };
        });
    }
    return ConservativeMap(view, hasBox, lookUpOf(scene, view), std::move(texels));
  };
}

const std::vector<ConservativeEntry>& publishedCrsm()
{
  static const std::vector<ConservativeEntry> entries = {
    { infoOfPublished("crsm_as_published"),
      [](const ShadowSettings&) { return publishedRule(PublishedLayers::Crsm); } },
    { infoOfPublished("crsma_as_published"),
      [](const ShadowSettings&) { return publishedRule(PublishedLayers::Crsma); } },
  };
  return entries;
}

} // namespace gnomon
