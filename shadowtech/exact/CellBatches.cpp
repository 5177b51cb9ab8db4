#include "shadowtech/exact/CellBatches.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// A shape with more texels than this is worth a work group of its own.
constexpr double mostTexelsOfWalk = 256.0;

template <typename Element>
std::size_t storageBytes(const std::vector<Element>& elements)
{
  return elements.size() * sizeof(Element);
}

} // namespace

//------------------------------------------------------------------------------
std::size_t RowWalks::largestBytes() const
{
  return std::max(storageBytes(this->ofShapes), storageBytes(this->ofRows));
}

//------------------------------------------------------------------------------
std::size_t PolygonBatch::largestBytes() const
{
  return std::max(storageBytes(this->records), storageBytes(this->sides));
}

//------------------------------------------------------------------------------
std::size_t SegmentBatch::largestBytes() const
{
  return std::max(storageBytes(this->records), this->walks.largestBytes());
}

//------------------------------------------------------------------------------
std::size_t TriangleBatch::largestBytes() const
{
  return std::max(this->polygons.largestBytes(), this->walks.largestBytes());
}

//------------------------------------------------------------------------------
std::size_t RingBatch::largestBytes() const
{
  return std::max({ this->polygons.largestBytes(), storageBytes(this->borders),
    storageBytes(this->records), this->walks.largestBytes() });
}

//------------------------------------------------------------------------------
void RowWalks::add(std::size_t shape, Span rows, double columns)
{
  const auto number = static_cast<std::uint32_t>(shape);
  if (rows.first > rows.last)
  {
    return;
  }
  if (columns * (rows.last - rows.first + 1) <= mostTexelsOfWalk)
  {
    this->ofShapes.emplace_back(number, static_cast<std::uint32_t>(rows.first));
    return;
  }
  for (int row = rows.first; row <= rows.last; row += invocationsPerGroup)
  {
    this->ofRows.emplace_back(number, static_cast<std::uint32_t>(row));
  }
}

//------------------------------------------------------------------------------
std::size_t PolygonBatch::add(const PolygonOnTexels& polygon)
{
  this->records.push_back(polygon.record());
  PolygonRecord& record = this->records.back();
  record.firstSide = static_cast<std::uint32_t>(this->sides.size());
  this->sides.insert(this->sides.end(), polygon.sides(), polygon.sides() + record.sideCount);
  return this->records.size() - 1;
}

//------------------------------------------------------------------------------
void SegmentBatch::add(const SegmentOnTexels& segment)
{
  const SegmentRecord& record = segment.record();
  const Span rows = segment.rows();
  // Each row of a steep segment has few columns.
  this->walks.add(this->records.size(), rows,
    2.0 + std::abs(record.alongX) * std::min(1.0, std::abs(record.perY)));
  this->records.push_back(record);
}

//------------------------------------------------------------------------------
void TriangleBatch::add(const MapPolygon& polygon, double margin, int width, Span rows)
{
  const PolygonOnTexels texels(polygon, margin, rows);
  if (texels.rows().first > texels.rows().last)
  {
    return;
  }
  const std::size_t number = this->polygons.add(texels);
  const PolygonRecord& record = texels.record();
  this->walks.add(number, texels.rows(),
    std::min(record.touchedRight, static_cast<double>(width)) - std::max(record.touchedLeft, 0.0));
}

//------------------------------------------------------------------------------
void RingBatch::add(const MapRing& ring, double margin, Span rows)
{
  const auto firstPolygon = static_cast<std::uint32_t>(this->polygons.records.size());
  for (const MapPolygon& triangle : ring.triangles)
  {
    this->polygons.add(PolygonOnTexels(triangle, margin, rows));
  }
  const auto firstSegment = static_cast<std::uint32_t>(this->borders.size());
  for (const MapSegment& border : ring.border)
  {
    this->borders.push_back(SegmentOnTexels(border, margin, rows).record());
  }
  const PolygonRecord& middle = this->polygons.records[firstPolygon];
  this->walks.add(this->records.size(), { middle.firstRow, middle.lastRow },
    middle.touchedRight - middle.touchedLeft);
  this->records.push_back({ firstPolygon, static_cast<std::uint32_t>(ring.triangles.size()),
    firstSegment, static_cast<std::uint32_t>(ring.border.size()) });
}

} // namespace gnomon
