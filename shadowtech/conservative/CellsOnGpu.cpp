#include "shadowtech/conservative/CellsOnGpu.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon
{
namespace
{

/// Draws what threads have collected.
template <typename Batch, typename Draw>
void drawBatches(tbb::enumerable_thread_specific<Batch>& batches, const Draw& draw)
{
  for (Batch& batch : batches)
  {
    draw(batch);
    batch = Batch();
  }
}

/// Some rows of a map.
class RowsOnGpu
{
public:
  RowsOnGpu(ShaderLibrary& shaders, CellPath path, const MapCasters& casters, int size, Span rows)
    : casters_(casters)
    , path_(path)
    , size_(size)
    , rows_(rows)
    , target_(shaders, path, size, rows)
  {
  }

  void drawSegments()
  {
    tbb::enumerable_thread_specific<SegmentBatch> batches;
    this->casters_.placements().visitInParts([this](const Placement& placement)
      { return this->casters_.edgeCount(placement); },
      [&](std::uint32_t placement, std::uint32_t i)
      {
        MapSegment found;
        if (this->casters_.segment({ placement, i }, found))
        {
          batches.local().add(SegmentOnTexels(found, this->casters_.margin(), this->rows_));
        }
      },
      [&]
      { drawBatches(batches, [this](const SegmentBatch& batch) { this->target_.draw(batch); }); });
  }

  void spoil(const std::vector<BandItem>& spoiling)
  {
    TriangleBatch batch;
    for (const BandItem& item : spoiling)
    {
      batch.add(this->casters_.polygon(item), this->casters_.margin(), this->size_, this->rows_,
        CellPath::Compute);
    }
    this->target_.spoil(batch);
    this->target_.endEdges();
  }

  void drawTriangles()
  {
    struct Batches
    {
      TriangleBatch triangles;
      RingBatch rings;
    };
    tbb::enumerable_thread_specific<Batches> batches;
    this->casters_.placements().visitInParts([this](const Placement& placement)
      { return this->casters_.placements().surfaceOf(placement).triangleCount; },
      [&](std::uint32_t number, std::uint32_t i)
      {
        const Placement& placement = this->casters_.placements()[number];
        const BandItem item{ number,
          this->casters_.placements().surfaceOf(placement).firstTriangle + i };
        const MapPolygon polygon = this->casters_.polygon(item);
        if (polygon.facing == 0)
        {
          return; // its edges alone are drawn, or it spoils texels
        }
        Batches& local = batches.local();
        local.triangles.add(
          polygon, this->casters_.margin(), this->size_, this->rows_, this->path_);
        if (this->casters_.covering() != Covering::Triangle && polygon.role.covers)
        {
          local.rings.add(this->casters_.ring(item, polygon), this->casters_.margin(), this->rows_);
        }
      },
      [&]
      {
        drawBatches(batches,
          [this](const Batches& batch)
          {
            this->target_.draw(batch.triangles);
            this->target_.draw(batch.rings);
          });
      });
  }

  void read(const TakeCell& take)
  {
    const std::size_t first =
      static_cast<std::size_t>(this->rows_.first) * static_cast<std::size_t>(this->size_);
    this->target_.read([&](std::size_t i, const Cell& cell) { take(first + i, cell); });
  }

private:
  const MapCasters& casters_;
  CellPath path_;
  int size_;
  Span rows_;
  CellTarget target_;
};

} // namespace

//------------------------------------------------------------------------------
bool CellsOnGpu::draw(const CasterScene& scene, const CasterEdges& edges, int size,
  Covering covering, const TakeCell& take) const
{
  tbb::enumerable_thread_specific<std::vector<BandItem>> found;
  const MapCasters casters(scene, edges, covering,
    [&](const BandItem& triangle, const MapPolygon& polygon)
    {
      if (polygon.role.poison)
      {
        found.local().push_back(triangle);
      }
    });
  if (casters.blind())
  {
    return false;
  }
  std::vector<BandItem> spoiling;
  for (const std::vector<BandItem>& some : found)
  {
    spoiling.insert(spoiling.end(), some.begin(), some.end());
  }
  const int most = CellTarget::mostRows(size, this->mostBytes_);
  for (int first = 0; first < size; first += most)
  {
    RowsOnGpu rows(
      this->shaders_, this->path_, casters, size, { first, std::min(first + most, size) - 1 });
    rows.drawSegments();
    rows.spoil(spoiling);
    rows.drawTriangles();
    rows.read(take);
  }
  return true;
}

} // namespace gnomon
