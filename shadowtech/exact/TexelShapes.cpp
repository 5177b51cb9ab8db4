#include "shadowtech/exact/TexelShapes.h"

#include <cmath>
#include <limits>

namespace gnomon
{

//------------------------------------------------------------------------------
PolygonOnTexels::PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows)
{
  PolygonRecord& record = this->record_;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  record.left = infinity;
  record.right = -infinity;
  record.least = std::numeric_limits<float>::infinity();
  record.most = -std::numeric_limits<float>::infinity();
  double low = infinity, high = -infinity;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    const MapCorner& corner = polygon.corners[i];
    record.left = std::min(record.left, corner.x);
    record.right = std::max(record.right, corner.x);
    low = std::min(low, corner.y);
    high = std::max(high, corner.y);
    record.least = std::min(record.least, static_cast<float>(corner.depth));
    record.most = std::max(record.most, static_cast<float>(corner.depth));
  }
  const double reach = polygon.role.poison ? std::max(margin, polygon.margin) : margin;
  record.touchedLeft = record.left - 0.5 - reach;
  record.touchedRight = record.right + 0.5 + reach;
  const Span inside = spanOf(low - reach, high + reach, rows.last + 1);
  record.firstRow = std::max(rows.first, inside.first);
  record.lastRow = inside.last;

  const MapPlane plane = planeOf(polygon);
  record.originX = plane.origin.x;
  record.originY = plane.origin.y;
  record.originDepth = plane.origin.depth;
  record.perX = plane.perX;
  record.perY = plane.perY;
  record.toSample = (plane.perX + plane.perY) * sampleOffset;
  const double slope = std::abs(plane.perX) + std::abs(plane.perY);
  record.spread = slope * (0.5 + reach);
  record.climb =
    static_cast<float>((slope * (0.5 + sampleOffset + reach) + polygon.slack) * 1.000001);
  record.slack = static_cast<float>(polygon.slack);
  record.noise = static_cast<float>(polygon.noise);
  record.covers = polygon.role.covers ? 1 : 0;
  this->findSides(polygon, plane.area > 0.0 ? 1.0 : -1.0, reach);
}

//------------------------------------------------------------------------------
void PolygonOnTexels::findSides(const MapPolygon& polygon, double orientation, double margin)
{
  this->record_.firstSide = this->record_.sideCount = 0;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    const MapCorner& a = polygon.corners[i];
    const MapCorner& b = polygon.corners[(i + 1) % polygon.count];
    const double ex = b.x - a.x, ey = b.y - a.y;
    const double length = std::hypot(ex, ey);
    if (length > 1e-9) // clipping may make corners coincide
    {
      const double nx = -orientation * ey / length, ny = orientation * ex / length;
      this->sides_[this->record_.sideCount++] = { boundPerRest(nx), ny, -(nx * a.x + ny * a.y),
        (std::abs(nx) + std::abs(ny)) * (0.5 + margin) };
    }
  }
}

//------------------------------------------------------------------------------
PolygonOnTexels::Row PolygonOnTexels::row(int y, int width) const
{
  const PolygonRecord& record = this->record_;
  RowRange touched{ record.touchedLeft, record.touchedRight };
  RowRange contained{ record.left, record.right };
  RowRange sampled{ record.left - sampleOnEdge, record.right + sampleOnEdge };
  const double centre = y + 0.5;
  for (std::size_t i = 0; i < record.sideCount; ++i)
  {
    const SideRecord& side = this->sides_[i];
    const double rest = side.ny * centre + side.c;
    touched.cut(side.perNx, rest + side.support);
    contained.cut(side.perNx, rest - side.support);
    sampled.cut(side.perNx, rest + side.ny * sampleOffset + sampleOnEdge);
  }
  return { touched.texels(0.5, width), contained.texels(0.5, width),
    sampled.texels(0.5 + sampleOffset, width),
    record.originDepth + record.perX * (0.5 - record.originX) +
      record.perY * (centre - record.originY) };
}

//------------------------------------------------------------------------------
SegmentOnTexels::SegmentOnTexels(const MapSegment& segment, double margin, Span rows)
{
  const auto& [a, b] = segment.ends;
  const auto perTexel = [](double extent) { return std::abs(extent) < 1e-12 ? 0.0 : 1.0 / extent; };
  SegmentRecord& record = this->record_;
  record.x = a.x;
  record.y = a.y;
  record.depth = a.depth;
  record.alongX = b.x - a.x;
  record.alongDepth = b.depth - a.depth;
  record.perX = perTexel(b.x - a.x);
  record.perY = perTexel(b.y - a.y);
  record.margin = margin + thinTexels;
  record.slack = segment.slack;
  record.isEnd = segment.isEnd ? 1 : 0;
  const Span inside =
    spanOf(std::min(a.y, b.y) - record.margin, std::max(a.y, b.y) + record.margin, rows.last + 1);
  record.firstRow = std::max(rows.first, inside.first);
  record.lastRow = inside.last;
}

} // namespace gnomon
