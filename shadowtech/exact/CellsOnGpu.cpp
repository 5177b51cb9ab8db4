#include "shadowtech/exact/CellsOnGpu.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace gnomon
{
namespace
{

/// Bakes some rows of a map.
class RowsOnGpu
{
public:
  /// @param mostBytes limit for a buffer of records (CollectedBatches)
  RowsOnGpu(
    ShaderLibrary& shaders, std::size_t mostBytes, const MapCasters& casters, int size, Span rows)
    : casters_(casters)
    , mostBytes_(mostBytes)
    , size_(size)
    , rows_(rows)
    , target_(shaders, size, rows)
  {
  }

  void drawSegments()
  {
    CollectedBatches<SegmentBatch> batches(this->mostBytes_);
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
      [&] { batches.drawAll([this](const SegmentBatch& batch) { this->target_.draw(batch); }); });
  }

  void spoil(const std::vector<BandItem>& spoiling)
  {
    CollectedBatches<TriangleBatch> batches(this->mostBytes_);
    for (const BandItem& item : spoiling)
    {
      this->add(this->casters_.polygon(item), batches);
    }
    batches.drawAll([this](const TriangleBatch& batch) { this->target_.spoil(batch); });
    this->target_.endPass();
  }

  void drawTriangles()
  {
    CollectedBatches<TriangleBatch> triangles(this->mostBytes_);
    CollectedBatches<RingBatch> rings(this->mostBytes_);
    this->visitTriangles(
      [&](const BandItem& item, const MapPolygon& polygon)
      {
        this->add(polygon, triangles);
        if (this->casters_.covering() != Covering::Triangle && polygon.role.covers)
        {
          rings.local().add(
            this->casters_.ring(item, polygon), this->casters_.margin(), this->rows_);
        }
      },
      [&]
      {
        triangles.drawAll([this](const TriangleBatch& batch) { this->target_.draw(batch); });
        rings.drawAll([this](const RingBatch& batch) { this->target_.draw(batch); });
      });
    this->target_.endPass();
  }

  void drawNoise()
  {
    CollectedBatches<TriangleBatch> triangles(this->mostBytes_);
    this->visitTriangles([&](const BandItem&, const MapPolygon& polygon)
      { this->add(polygon, triangles); },
      [&] {
        triangles.drawAll([this](const TriangleBatch& batch) { this->target_.drawNoise(batch); });
      });
  }

  void read(const TakeCell& take)
  {
    const std::size_t first =
      static_cast<std::size_t>(this->rows_.first) * static_cast<std::size_t>(this->size_);
    this->target_.read([&](std::size_t i, const Cell& cell) { take(first + i, cell); });
  }

private:
  /// Visit rasterized triangles in parts, as visitInParts().
  template <typename Visit, typename FinishPart>
  void visitTriangles(const Visit& visit, const FinishPart& finishPart) const
  {
    const CasterPlacements& placements = this->casters_.placements();
    placements.visitInParts([&](const Placement& placement)
      { return placements.surfaceOf(placement).triangleCount; },
      [&](std::uint32_t number, std::uint32_t i)
      {
        const BandItem item{ number, placements.surfaceOf(placements[number]).firstTriangle + i };
        const MapPolygon polygon = this->casters_.polygon(item);
        if (polygon.facing != 0) // other triangles are edges alone, or leave texels undecided
        {
          visit(item, polygon);
        }
      },
      finishPart);
  }

  void add(const MapPolygon& polygon, CollectedBatches<TriangleBatch>& triangles) const
  {
    triangles.local().add(polygon, this->casters_.margin(), this->size_, this->rows_);
  }

  const MapCasters& casters_;
  std::size_t mostBytes_;
  int size_;
  Span rows_;
  CellTarget target_;
};

} // namespace

//------------------------------------------------------------------------------
bool CellsOnGpu::draw(const CasterScene& scene, const CasterEdges& edges, int size,
  Covering covering, const TakeCell& take) const
{
  if (covering == Covering::Silhouette)
  {
    throw std::logic_error("the GPU cannot bake maps of silhouettes");
  }
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
  const int most = CellTarget::mostRows(size, this->room_.cells);
  for (int first = 0; first < size; first += most)
  {
    RowsOnGpu rows(this->shaders_, this->room_.records, casters, size,
      { first, std::min(first + most, size) - 1 });
    rows.drawSegments();
    rows.spoil(spoiling);
    rows.drawTriangles();
    rows.drawNoise();
    rows.read(take);
  }
  return true;
}

} // namespace gnomon
