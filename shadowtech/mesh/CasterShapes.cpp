#include "shadowtech/mesh/CasterShapes.h"

#include "shadowtech/base/PlacedTriangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallestDivisor = std::numeric_limits<double>::min();

/// Width of the border around the map in which casters are rasterized: larger than any margin.
constexpr double padTexels = 16.0;

/// A corner of a clipped polygon, and the triangle's side that leads on from it.
struct CutCorner : MapPoint
{
  std::uint8_t side = noSide;
};
using CutCorners = std::array<CutCorner, mostCorners + 1>;

MapPoint mix(const MapPoint& a, const MapPoint& b, double t)
{
  return { a.X + t * (b.X - a.X), a.Y + t * (b.Y - a.Y), a.W + t * (b.W - a.W),
    a.Q + t * (b.Q - a.Q), a.z + t * (b.z - a.z) };
}

/// Clip a convex polygon to distance(corner) >= 0.
template <typename Distance>
void cut(CutCorners& corners, std::size_t& count, const Distance& distance)
{
  CutCorners kept;
  std::size_t keptCount = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const CutCorner& a = corners[i];
    const CutCorner& b = corners[(i + 1) % count];
    const double da = distance(a);
    const double db = distance(b);
    if (da >= 0.0)
    {
      kept[keptCount++] = a;
    }
    if ((da >= 0.0) != (db >= 0.0))
    {
      kept[keptCount++] = { mix(a, b, da / (da - db)), da >= 0.0 ? noSide : a.side };
    }
  }
  std::copy_n(kept.begin(), keptCount, corners.begin());
  count = keptCount;
}

/// Clip a segment or a convex polygon to the map and its border.
/// @param size side of the map, in texels
/// @param nearW the least W that counts; points at or below it are at the light
/// @return false if the clipped part reaches the light
bool cutToMap(CutCorners& corners, std::size_t& count, double size, double nearW)
{
  const double low = -padTexels;
  const double high = size + padTexels;
  const auto isIn = [&](const MapPoint& p)
  {
    return p.W > nearW && p.X >= low * p.W && p.X <= high * p.W && p.Y >= low * p.W &&
      p.Y <= high * p.W;
  };
  if (std::all_of(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count), isIn))
  {
    return true;
  }
  cut(corners, count, [&](const MapPoint& p) { return p.X - low * p.W; });
  cut(corners, count, [&](const MapPoint& p) { return high * p.W - p.X; });
  cut(corners, count, [&](const MapPoint& p) { return p.Y - low * p.W; });
  cut(corners, count, [&](const MapPoint& p) { return high * p.W - p.Y; });
  return std::all_of(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count),
    [&](const MapPoint& p) { return p.W > nearW; });
}

/// How far off its plane a tracer may see a triangle.
struct Noise
{
  double alongNormal = infinity; ///< world units; infinite if no bound exists
  double cosineToLight = 0.0;    ///< of the normal; the least over the triangle

  double alongRay() const
  {
    const double cosine = std::abs(this->cosineToLight);
    return cosine > 0.0 ? this->alongNormal / cosine : infinity;
  }
};

Noise tracersNoise(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  std::uint32_t triangle, const std::array<glm::dvec3, 3>& corners)
{
  Noise result;
  const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double doubleArea = glm::length(areaVector);
  if (!(doubleArea > 0.0))
  {
    return result;
  }
  const glm::dvec3 normal = areaVector / doubleArea;
  // N.(position - corner) is the same for all points of a plane.
  if (scene.space.positional)
  {
    double farthest = 0.0;
    for (const glm::dvec3& corner : corners)
    {
      farthest = std::max(farthest, glm::length(scene.towards - corner));
    }
    result.cosineToLight =
      farthest > 0.0 ? glm::dot(normal, scene.towards - corners[0]) / farthest : 0.0;
  }
  else
  {
    result.cosineToLight = glm::dot(normal, scene.towards);
  }
  // planeNoise() does not bound slivers.
  const auto& [a, b, c] = corners;
  const glm::dvec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  const double longest = std::max({ extent.x, extent.y, extent.z });
  if (std::ldexp(extent.x * extent.y * extent.z, -19) < std::ldexp(longest * doubleArea, -10))
  {
    result.alongNormal =
      noiseOf(scene.occluders, surface, instance, triangle, corners, normal, doubleArea);
  }
  return result;
}

/// Return the cosine below which a tracer may take a one-sided triangle to face either way.
double unclearCosine(const std::array<glm::dvec3, 3>& corners)
{
  const glm::dvec3 ab = corners[1] - corners[0];
  const glm::dvec3 ac = corners[2] - corners[0];
  const double longest = std::max(glm::dot(ab, ab), glm::dot(ac, ac));
  return std::max(1e-5, std::ldexp(longest, -19) / glm::length(glm::cross(ab, ac)));
}

/// Return the margin of a caster, in texels.
/// @param nearestZ its least distance from the light, along the view
double marginOf(const CasterScene& scene, double nearestZ)
{
  const double perUnit =
    scene.space.positional ? scene.texelsPerUnit / nearestZ : scene.texelsPerUnit;
  return marginTexels + perUnit * scene.lateral;
}

/// Return true if the margin of a triangle near a positional light might exceed the map's border.
bool isAtLight(const CasterScene& scene, const std::array<glm::dvec3, 3>& corners)
{
  if (!scene.space.positional)
  {
    return false;
  }
  const double distance = scene.texelsPerUnit * scene.lateral / (0.5 * padTexels);
  const auto& [a, b, c] = corners;
  const glm::dvec3 areaVector = glm::cross(b - a, c - a);
  const glm::dvec3 beside = glm::max(
    glm::min(a, glm::min(b, c)) - scene.towards, scene.towards - glm::max(a, glm::max(b, c)));
  return glm::length(glm::max(beside, glm::dvec3(0.0))) <= distance &&
    std::abs(glm::dot(areaVector, scene.towards - a)) <= distance * glm::length(areaVector);
}

/// Return the most texels that one unit across the light covers on the map.
double largestTexelsPerAcross(const LightView& view, double size)
{
  const glm::dmat3 acrossFromMap = glm::inverse(view.mapFromAcross);
  double largest = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const glm::dvec2 map((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0);
    const glm::dvec3 across = acrossFromMap * glm::dvec3(map, 1.0);
    const double w = (view.mapFromAcross * (across / across.z)).z;
    for (int axis = 0; axis < 2; ++axis)
    {
      const glm::dvec3& column = view.mapFromAcross[axis];
      largest = std::max(largest, glm::length(glm::dvec2(column) - map * column.z) / w);
    }
  }
  return std::sqrt(2.0) * 0.5 * size * largest;
}

} // namespace

glm::dmat4 MapSpace::mapFromCentred(double constant) const
{
  const glm::dmat3& map = this->texelFromAcross;
  const auto column = [&](const glm::dvec3& across, double ownDepth)
  { return glm::dvec4(across.x, across.y, ownDepth + constant * across.z, across.z); };
  const glm::dvec3 none(0.0);
  const glm::dmat4 mapFromView = this->positional
    ? glm::dmat4(column(map[0], 0.0), column(map[1], 0.0), column(map[2], 0.0),
        column(none, -this->depthScale))
    : glm::dmat4(column(map[0], 0.0), column(map[1], 0.0), column(none, this->depthScale),
        column(map[2], 0.0));
  return mapFromView * this->viewFromCentred;
}

CasterScene casterScene(
  const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders)
{
  const bool positional = view.rays.positional;
  const glm::dmat4& viewFromCentred = view.rays.viewFromCentred;
  const glm::dmat4 centredFromView = glm::inverse(viewFromCentred);
  const glm::dvec3 position(centredFromView[3]);

  double nearestZ = infinity;
  double farthestZ = -infinity;
  for (const glm::dvec3& corner : occluders.castersCentred.corners())
  {
    const double z = glm::dvec3(viewFromCentred * glm::dvec4(corner, 1.0)).z;
    nearestZ = std::min(nearestZ, z);
    farthestZ = std::max(farthestZ, z);
  }
  // Rays end at a box's near face to within rounding, wherever the first caster is.
  const double begins = hasBox ? 0.0 : view.beginsAt;
  nearestZ = std::max(nearestZ, begins);
  // W in the map's middle scales depths. Elsewhere in warped views, W is a few times that at most.
  const glm::dvec3 across = glm::inverse(view.mapFromAcross) * glm::dvec3(0.0, 0.0, 1.0);
  const double middleW = (view.mapFromAcross * (across / across.z)).z;
  const double low = positional ? -1.0 / (nearestZ * middleW) : nearestZ / middleW;
  const double high = positional ? -1.0 / (farthestZ * middleW) : farthestZ / middleW;
  // All casters may have one depth.
  const double extent =
    std::max({ high - low, 1e-6 * std::max(std::abs(high), std::abs(low)), smallestDivisor });

  // Rounding of rays and casters is proportional to their coordinates relative to a ray's origin.
  double largest = 0.0;
  for (const glm::dvec3& corner : occluders.allCentred.corners())
  {
    largest = std::max(largest, glm::length(corner));
  }
  largest = 2.0 * largest + (positional || hasBox ? glm::length(position) : 0.0);

  const glm::dmat3 texels = texelFromAcross(view, sizeTexels);
  const glm::dvec3 gradient(texels[0].z, texels[1].z, positional ? texels[2].z : 0.0);
  const double farthest = positional
    ? 0.0
    : std::abs((viewFromCentred * glm::dvec4(occluders.allCentred.centre(), 1.0)).z) +
      occluders.allCentred.radius();
  // Up to 60 degrees off the view's axis, rays and the sides of texels are up to twice as long.
  const double lateral = std::ldexp(largest, -18) * (positional ? 2.0 : 1.0);
  return { occluders,
    { positional, viewFromCentred, texels, 1.0 / extent, -low / extent,
      static_cast<double>(sizeTexels), glm::length(gradient), farthest },
    begins, positional ? 1e-6 * nearestZ * middleW : 0.0, lateral,
    largestTexelsPerAcross(view, sizeTexels),
    positional ? position : -glm::dvec3(centredFromView[2]) };
}

std::pair<double, double> MapPolygon::rows() const
{
  const auto [low, high] = std::minmax_element(this->corners.begin(),
    this->corners.begin() + static_cast<std::ptrdiff_t>(this->count),
    [](const MapCorner& a, const MapCorner& b) { return a.y < b.y; });
  return { low->y, high->y };
}

MapPolygon polygonOf(
  const CasterScene& scene, const Surface& surface, std::uint32_t instance, std::uint32_t triangle)
{
  MapPolygon polygon;
  const std::array<glm::dvec3, 3> corners =
    centredCorners(scene.occluders, surface, instance, triangle);
  CutCorners points;
  for (std::uint8_t k = 0; k < 3; ++k)
  {
    points[k] = { scene.space.at(corners[k]), k };
  }
  const double nearestZ = std::min({ points[0].z, points[1].z, points[2].z });
  const double farthestZ = std::max({ points[0].z, points[1].z, points[2].z });
  if (farthestZ < scene.begins - scene.lateral && !scene.space.positional)
  {
    return polygon;
  }
  std::size_t count = 3;
  const bool apart = cutToMap(points, count, scene.space.size, scene.nearW);
  const bool atLight = isAtLight(scene, corners);
  if (!apart || (atLight && count < 3))
  {
    polygon.role.present = true;
    polygon.margin = infinity;
    return polygon;
  }
  if (count < 3)
  {
    return polygon;
  }
  polygon.role.present = true;
  const Noise noise = tracersNoise(scene, surface, instance, triangle, corners);
  // One-sided casters that face away from the light do not exist. A tracer may see a triangle along
  // the light either way.
  const bool unclear =
    surface.oneSided && !(std::abs(noise.cosineToLight) > unclearCosine(corners));
  if (surface.oneSided && !unclear && noise.cosineToLight < 0.0 && !atLight)
  {
    polygon.role.present = false;
    return polygon;
  }

  polygon.nearestZ = infinity;
  polygon.count = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapPoint& p = points[i];
    polygon.corners[i] = { p.X / p.W, p.Y / p.W, p.Q / p.W };
    polygon.sides[i] = points[i].side;
    polygon.nearestZ = std::min(polygon.nearestZ, p.z);
    polygon.depthPerUnit = std::max(polygon.depthPerUnit, scene.space.depthPerUnit(p.W));
  }
  polygon.margin = atLight ? infinity : marginOf(scene, polygon.nearestZ);
  polygon.slack = noise.alongRay() * polygon.depthPerUnit;
  polygon.noise = noise.alongNormal;
  // A polygon is thin if twice its area over its longest side, its height, is small.
  double area = 0.0;
  double longest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapCorner& a = polygon.corners[i];
    const MapCorner& b = polygon.corners[(i + 1) % count];
    const MapCorner& o = polygon.corners[0];
    area += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
    longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
  }
  const bool thin = !(std::abs(area) > thinTexels * longest);
  polygon.role.poison = polygon.margin > largestMargin ||
    polygon.nearestZ < scene.begins + scene.lateral || nearestZ < scene.begins - scene.lateral ||
    (!thin && (unclear || !std::isfinite(polygon.slack)));
  polygon.facing = thin || polygon.role.poison ? 0 : area > 0.0 ? 1 : -1;
  polygon.role.covers = polygon.facing != 0 && !surface.cutout;
  return polygon;
}

MapPlane planeOf(const MapPolygon& polygon)
{
  MapPlane plane;
  plane.origin = polygon.corners[0];
  // The largest triangle between three corners gives the plane.
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.count; ++i)
  {
    for (std::size_t j = i + 1; j < polygon.count; ++j)
    {
      const MapCorner& b = polygon.corners[i];
      const MapCorner& c = polygon.corners[j];
      const double bx = b.x - plane.origin.x, by = b.y - plane.origin.y;
      const double cx = c.x - plane.origin.x, cy = c.y - plane.origin.y;
      const double bz = b.depth - plane.origin.depth, cz = c.depth - plane.origin.depth;
      const double doubleArea = bx * cy - cx * by;
      plane.area += j == i + 1 ? 0.5 * doubleArea : 0.0;
      if (std::abs(doubleArea) > largest)
      {
        largest = std::abs(doubleArea);
        plane.perX = (bz * cy - cz * by) / doubleArea;
        plane.perY = (bx * cz - cx * bz) / doubleArea;
      }
    }
  }
  return plane;
}

EdgeKind kindOf(const CasterEdge& edge, std::int8_t firstFacing, std::int8_t secondFacing)
{
  if (firstFacing == 0 || secondFacing == 0)
  {
    return EdgeKind::Unsure;
  }
  if (firstFacing == absentFacing || secondFacing == absentFacing ||
    (firstFacing == secondFacing) == edge.sameDirection)
  {
    return EdgeKind::End;
  }
  return edge.sharp ? EdgeKind::Sharp : EdgeKind::Inner;
}

bool segmentOf(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  const CasterEdge& edge, EdgeKind kind, MapSegment& segment)
{
  CutCorners points;
  points[0] = { scene.space.at(centredVertex(scene.occluders, surface, instance, edge.from)) };
  points[1] = { scene.space.at(centredVertex(scene.occluders, surface, instance, edge.to)) };
  std::size_t count = 2;
  // Clip the segment as a polygon of two sides, which returns both ends twice.
  if (!cutToMap(points, count, scene.space.size, scene.nearW) || count < 2)
  {
    return false;
  }
  std::array<MapCorner, mostCorners + 1> corners;
  std::array<std::size_t, 2> ends{ { 0, 0 } };
  double longest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    corners[i] = { points[i].X / points[i].W, points[i].Y / points[i].W,
      points[i].Q / points[i].W };
    const double length = std::hypot(corners[i].x - corners[0].x, corners[i].y - corners[0].y);
    if (length > longest)
    {
      longest = length;
      ends[1] = i;
    }
  }
  double rate = 0.0;
  segment.ends = { { corners[ends[0]], corners[ends[1]] } };
  for (const std::size_t end : ends)
  {
    const MapPoint& p = points[end];
    rate = std::max(rate, scene.space.depthPerUnit(p.W));
  }
  segment.slack = kind == EdgeKind::Unsure ? infinity : rate * scene.lateral;
  segment.isEnd = kind != EdgeKind::Sharp;
  return true;
}

} // namespace gnomon
