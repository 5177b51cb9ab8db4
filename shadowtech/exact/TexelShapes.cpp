#include "shadowtech/exact/TexelShapes.h"

#include <cmath>
#include <limits>

namespace gnomon
{

//------------------------------------------------------------------------------
PolygonOnTexels::PolygonOnTexels(const MapPolygon& polygon, double margin, Span rows)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  this->left_ = infinity;
  this->right_ = -infinity;
  this->least_ = std::numeric_limits<float>::infinity();
  this->most_ = -std::numeric_limits<float>::infinity();
  double low = infinity, high = -infinity;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    const MapCorner& corner = polygon.corners[i];
    this->left_ = std::min(this->left_, corner.x);
    this->right_ = std::max(this->right_, corner.x);
    low = std::min(low, corner.y);
    high = std::max(high, corner.y);
    this->least_ = std::min(this->least_, static_cast<float>(corner.depth));
    this->most_ = std::max(this->most_, static_cast<float>(corner.depth));
  }
  const double reach = polygon.role.poison ? std::max(margin, polygon.margin) : margin;
  this->touchedLeft_ = this->left_ - 0.5 - reach;
  this->touchedRight_ = this->right_ + 0.5 + reach;
  const Span inside = spanOf(low - reach, high + reach, rows.last + 1);
  this->firstRow_ = std::max(rows.first, inside.first);
  this->lastRow_ = inside.last;

  const MapPlane plane = planeOf(polygon);
  this->originX_ = plane.origin.x;
  this->originY_ = plane.origin.y;
  this->originDepth_ = plane.origin.depth;
  this->perX_ = plane.perX;
  this->perY_ = plane.perY;
  this->toSample_ = (plane.perX + plane.perY) * sampleOffset;
  const double slope = std::abs(plane.perX) + std::abs(plane.perY);
  this->spread_ = slope * (0.5 + reach);
  this->climb_ =
    static_cast<float>((slope * (0.5 + sampleOffset + reach) + polygon.slack) * 1.000001);
  this->slack_ = static_cast<float>(polygon.slack);
  this->noise_ = static_cast<float>(polygon.noise);
  this->findSides(polygon, plane.area > 0.0 ? 1.0 : -1.0, reach);
}

//------------------------------------------------------------------------------
void PolygonOnTexels::findSides(const MapPolygon& polygon, double orientation, double margin)
{
  this->sideCount_ = 0;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    const MapCorner& a = polygon.corners[i];
    const MapCorner& b = polygon.corners[(i + 1) % polygon.count];
    const double ex = b.x - a.x, ey = b.y - a.y;
    const double length = std::hypot(ex, ey);
    if (length > 1e-9) // clipping may make corners coincide
    {
      const double nx = -orientation * ey / length, ny = orientation * ex / length;
      this->sides_[this->sideCount_++] = { boundPerRest(nx), ny, -(nx * a.x + ny * a.y),
        (std::abs(nx) + std::abs(ny)) * (0.5 + margin) };
    }
  }
}

//------------------------------------------------------------------------------
PolygonOnTexels::Row PolygonOnTexels::row(int y, int width) const
{
  RowRange touched{ this->touchedLeft_, this->touchedRight_ };
  RowRange contained{ this->left_, this->right_ };
  RowRange sampled{ this->left_ - sampleOnEdge, this->right_ + sampleOnEdge };
  const double centre = y + 0.5;
  for (std::size_t i = 0; i < this->sideCount_; ++i)
  {
    const Side& side = this->sides_[i];
    const double rest = side.ny * centre + side.c;
    touched.cut(side.perNx, rest + side.support);
    contained.cut(side.perNx, rest - side.support);
    sampled.cut(side.perNx, rest + side.ny * sampleOffset + sampleOnEdge);
  }
  return { touched.texels(0.5, width), contained.texels(0.5, width),
    sampled.texels(0.5 + sampleOffset, width),
    this->originDepth_ + this->perX_ * (0.5 - this->originX_) +
      this->perY_ * (centre - this->originY_) };
}

//------------------------------------------------------------------------------
SegmentOnTexels::SegmentOnTexels(const MapSegment& segment, double margin, Span rows)
{
  const auto& [a, b] = segment.ends;
  const auto perTexel = [](double extent) { return std::abs(extent) < 1e-12 ? 0.0 : 1.0 / extent; };
  this->x_ = a.x;
  this->y_ = a.y;
  this->depth_ = a.depth;
  this->alongX_ = b.x - a.x;
  this->alongDepth_ = b.depth - a.depth;
  this->perX_ = perTexel(b.x - a.x);
  this->perY_ = perTexel(b.y - a.y);
  this->margin_ = margin + thinTexels;
  this->slack_ = segment.slack;
  const Span inside =
    spanOf(std::min(a.y, b.y) - this->margin_, std::max(a.y, b.y) + this->margin_, rows.last + 1);
  this->firstRow_ = std::max(rows.first, inside.first);
  this->lastRow_ = inside.last;
}

} // namespace gnomon
