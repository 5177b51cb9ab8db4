#include "shadowtech/exact/CellsOnCpu.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

namespace gnomon
{
namespace
{

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

  /// Rasterize all bands.
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

} // namespace

//------------------------------------------------------------------------------
bool drawCellsOnCpu(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
  const TakeCell& take)
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
