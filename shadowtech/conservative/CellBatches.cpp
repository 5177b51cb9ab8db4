#include "shadowtech/conservative/CellBatches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

/// What has more texels is worth a work group.
constexpr double mostTexelsOfWalk = 256.0;

/// A rectangle with a side along a unit vector.
struct TurnedBox
{
  glm::dvec2 along;
  glm::dvec2 low, high; ///< along that vector, and to its left

  glm::dvec2 placeOf(const glm::dvec2& at) const
  {
    return at.x * this->along + at.y * glm::dvec2(-this->along.y, this->along.x);
  }
  double area() const
  {
    const glm::dvec2 sides = glm::max(this->high - this->low, 0.0);
    return sides.x * sides.y;
  }
};

/// The one that holds all squares around corners with sides of twice the reach.
TurnedBox rectangleAround(
  const std::vector<glm::dvec2>& corners, const glm::dvec2& along, double reach)
{
  TurnedBox result{ along, glm::dvec2(std::numeric_limits<double>::infinity()),
    glm::dvec2(-std::numeric_limits<double>::infinity()) };
  for (const glm::dvec2& corner : corners)
  {
    const glm::dvec2 at(glm::dot(along, corner), along.x * corner.y - along.y * corner.x);
    result.low = glm::min(result.low, at);
    result.high = glm::max(result.high, at);
  }
  const double further = reach * (std::abs(along.x) + std::abs(along.y));
  result.low -= further;
  result.high += further;
  return result;
}

using Triangle2 = std::array<glm::dvec2, 3>;

/// A triangle, larger so that every side has moved outwards by enough; none where it would be more than twice as large, as of
/// needles, or leave what is drawn: the specification does not say how exactly OpenGL cuts.
/// @param half the extent of what is drawn, from its middle
std::optional<Triangle2> grown(const std::vector<glm::dvec2>& corners, const glm::dvec2& longest,
  double reach, const glm::dvec2& half)
{
  if (corners.size() != 3)
  {
    return std::nullopt;
  }
  // It is scaled about its centre of gravity, which is a third of the height from a side; a square reaches along a unit
  // normal sqrt(2) < 1.5 times as far as in x and in y.
  const glm::dvec2 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  const glm::dvec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  // Infinite without area; of a point it is 0 / 0, which is not less than 1.
  const double further =
    3.0 * 1.5 * reach * glm::length(longest) / std::abs(ab.x * ac.y - ab.y * ac.x);
  if (!(further < 1.0))
  {
    return std::nullopt;
  }
  Triangle2 shape;
  for (std::size_t k = 0; k < 3; ++k)
  {
    shape[k] = centre + (1.0 + further) * (corners[k] - centre);
    if (!glm::all(glm::lessThan(glm::abs(shape[k]), half)))
    {
      return std::nullopt;
    }
  }
  return shape;
}

/// A right angle around a rectangle: the box's part of what is drawn, or one along the longest side, as of needles.
Triangle2 rightAngleAround(const std::vector<glm::dvec2>& corners, const glm::dvec2& longest,
  double reach, const glm::dvec2& half)
{
  TurnedBox box = rectangleAround(corners, { 1.0, 0.0 }, reach);
  box.low = glm::max(box.low, -half);
  box.high = glm::min(box.high, half);
  const double length = glm::length(longest);
  if (length > 1.0)
  {
    const TurnedBox needle = rectangleAround(corners, longest / length, reach);
    const glm::dvec2 centre = needle.placeOf(0.5 * (needle.low + needle.high));
    const glm::dvec2 side = 0.5 * (needle.high - needle.low);
    const glm::dvec2 extent = glm::abs(side.x * needle.along) +
      glm::abs(side.y * glm::dvec2(needle.along.y, needle.along.x));
    if (glm::all(glm::lessThan(glm::abs(centre) + extent, half)) && needle.area() < box.area())
    {
      box = needle;
    }
  }
  const glm::dvec2 twice = box.low + 2.0 * (box.high - box.low);
  return { { box.placeOf(box.low), box.placeOf({ twice.x, box.low.y }),
    box.placeOf({ box.low.x, twice.y }) } };
}

/// A triangle around a polygon.
/// @param reach how far beside the polygon the places may be, in x and in y, that it has to hold, in texels
/// @return its corners, in clip coordinates of some rows of a map
std::array<glm::vec2, 3> shapeAround(const MapPolygon& polygon, double reach, int width, Span rows)
{
  const glm::dvec2 half(0.5 * width, 0.5 * (rows.last - rows.first + 1));
  const glm::dvec2 middle(half.x, rows.first + half.y);
  std::vector<glm::dvec2> corners;
  for (std::size_t i = 0; i < polygon.count; ++i)
  {
    corners.push_back(glm::dvec2(polygon.corners[i].x, polygon.corners[i].y) - middle);
  }
  glm::dvec2 longest(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
    longest = glm::dot(side, side) > glm::dot(longest, longest) ? side : longest;
  }
  const std::optional<Triangle2> triangle = grown(corners, longest, reach, half);
  const Triangle2 shape = triangle ? *triangle : rightAngleAround(corners, longest, reach, half);
  return { { glm::vec2(shape[0] / half), glm::vec2(shape[1] / half), glm::vec2(shape[2] / half) } };
}

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
  return std::max(
    { this->polygons.largestBytes(), this->walks.largestBytes(), storageBytes(this->placesClip) });
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
  // Of what is steeper, each row has few columns.
  this->walks.add(this->records.size(), rows,
    2.0 + std::abs(record.alongX) * std::min(1.0, std::abs(record.perY)));
  this->records.push_back(record);
}

//------------------------------------------------------------------------------
void TriangleBatch::add(
  const MapPolygon& polygon, double margin, int width, Span rows, CellPath path)
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
  if (path != CellPath::Compute)
  {
    // What OpenGL rounds places to, and what floats do.
    const double snap = 0.0625 + std::ldexp(width, -19);
    const std::array<glm::vec2, 3> shape =
      shapeAround(polygon, margin + snap + (path == CellPath::Extension ? 0.0 : 0.5), width, rows);
    this->placesClip.insert(this->placesClip.end(), shape.begin(), shape.end());
  }
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
