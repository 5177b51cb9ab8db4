#include "shadowtech/conservative/CasterShapes.h"

#include "shadowtech/base/ShadowRay.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
/// What a divisor is at least.
constexpr double least = std::numeric_limits<double>::min();

/// What is drawn of casters around the map: more than any margin.
constexpr double padTexels = 4.0;

using CutCorners = std::array<MapPoint, mostCorners + 1>;

MapPoint mix(const MapPoint& a, const MapPoint& b, double t)
{
  return { a.X + t * (b.X - a.X), a.Y + t * (b.Y - a.Y), a.W + t * (b.W - a.W),
    a.Q + t * (b.Q - a.Q), a.z + t * (b.z - a.z) };
}

/// Cuts a convex polygon by distance(corner) >= 0.
template <typename Distance>
void cut(CutCorners& corners, std::size_t& count, const Distance& distance)
{
  CutCorners kept;
  std::size_t keptCount = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapPoint& a = corners[i];
    const MapPoint& b = corners[(i + 1) % count];
    const double da = distance(a);
    const double db = distance(b);
    if (da >= 0.0)
    {
      kept[keptCount++] = a;
    }
    if ((da >= 0.0) != (db >= 0.0))
    {
      kept[keptCount++] = mix(a, b, da / (da - db));
    }
  }
  std::copy_n(kept.begin(), keptCount, corners.begin());
  count = keptCount;
}

/// The part of a segment or a convex polygon that lies on the map or around it.
/// @param nearW the least W that counts; what reaches it is at the light
/// @return false where that part reaches the light
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

glm::dvec3 centredCorner(
  const Occluders& occluders, const Surface& surface, std::uint32_t instance, std::uint32_t vertex)
{
  const glm::dvec3 position = occluders.positionsCentred[vertex];
  return surface.isInstanced()
    ? glm::dmat4x3(surface.centredFromSource[instance]) * glm::dvec4(position, 1.0)
    : position;
}

/// How far along a ray a triangle may seem to be off, in world units; infinite where that cannot be bounded.
double slackOf(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  const glm::uvec3& vertices, const std::array<glm::dvec3, 3>& corners, double& cosineToLight)
{
  const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double doubleArea = glm::length(areaVector);
  cosineToLight = 0.0;
  if (!(doubleArea > 0.0))
  {
    return infinity;
  }
  const glm::dvec3 normal = areaVector / doubleArea;
  // Of a plane, N.(position - corner) is the same for all its points.
  if (scene.space.positional)
  {
    double farthest = 0.0;
    for (const glm::dvec3& corner : corners)
    {
      farthest = std::max(farthest, glm::length(scene.towards - corner));
    }
    cosineToLight = farthest > 0.0 ? glm::dot(normal, scene.towards - corners[0]) / farthest : 0.0;
  }
  else
  {
    cosineToLight = glm::dot(normal, scene.towards);
  }
  const auto& [a, b, c] = corners;
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  double noise = planeNoise(normal, largest, extent, static_cast<float>(doubleArea));
  if (surface.isInstanced())
  {
    const auto& positions = scene.occluders.positionsCentred;
    noise += instanceNoise(normal, corners,
      { positions[vertices.x], positions[vertices.y], positions[vertices.z] },
      surface.centredFromSource[instance], doubleArea);
  }
  const double cosine = std::abs(cosineToLight);
  return cosine > 0.0 ? noise / cosine : infinity;
}

/// The margin of what comes as near to the light as z.
double marginOf(const CasterScene& scene, double nearestZ)
{
  const double perUnit =
    scene.space.positional ? scene.texelsPerUnit / nearestZ : scene.texelsPerUnit;
  return marginTexels + perUnit * scene.lateral;
}

/// The most texels that a step across the light can be long, on the map.
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

//------------------------------------------------------------------------------
glm::dmat4 MapSpace::mapFromCentred() const
{
  const glm::dmat3& map = this->texelFromAcross;
  const auto column = [&](const glm::dvec3& across, double ownDepth)
  { return glm::dvec4(across.x, across.y, ownDepth + this->depthOffset * across.z, across.z); };
  const glm::dvec3 none(0.0);
  const glm::dmat4 mapFromView = this->positional
    ? glm::dmat4(column(map[0], 0.0), column(map[1], 0.0), column(map[2], 0.0),
        column(none, -this->depthScale))
    : glm::dmat4(column(map[0], 0.0), column(map[1], 0.0), column(none, this->depthScale),
        column(map[2], 0.0));
  return mapFromView * this->viewFromCentred;
}

//------------------------------------------------------------------------------
CasterScene casterScene(const LightView& view, int sizeTexels, const Occluders& occluders)
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
  nearestZ = std::max(nearestZ, view.beginsAt);
  // Depths are scaled by W in the map's middle. Warped views have others, a few times that at most.
  const glm::dvec3 across = glm::inverse(view.mapFromAcross) * glm::dvec3(0.0, 0.0, 1.0);
  const double middleW = (view.mapFromAcross * (across / across.z)).z;
  const double low = positional ? -1.0 / (nearestZ * middleW) : nearestZ / middleW;
  const double high = positional ? -1.0 / (farthestZ * middleW) : farthestZ / middleW;
  // All casters may have one depth.
  const double extent =
    std::max({ high - low, 1e-6 * std::max(std::abs(high), std::abs(low)), least });

  // What rays and casters are rounded in proportion to: their coordinates, relative to a ray's origin.
  double largest = 0.0;
  for (const glm::dvec3& corner : occluders.allCentred.corners())
  {
    largest = std::max(largest, glm::length(corner));
  }
  largest = 2.0 * largest + (positional ? glm::length(position) : 0.0);

  return { occluders,
    { positional, viewFromCentred, texelFromAcross(view, sizeTexels), 1.0 / extent, -low / extent,
      static_cast<double>(sizeTexels) },
    view.beginsAt, !positional, positional ? 1e-6 * nearestZ * middleW : 0.0,
    std::ldexp(largest, -18), largestTexelsPerAcross(view, sizeTexels),
    positional ? position : -glm::dvec3(centredFromView[2]) };
}

//------------------------------------------------------------------------------
double depthPerUnit(const MapSpace& space, double W, double z)
{
  return space.depthScale / (space.positional ? W * z : W);
}

//------------------------------------------------------------------------------
MapPolygon polygonOf(
  const CasterScene& scene, const Surface& surface, std::uint32_t instance, std::uint32_t triangle)
{
  MapPolygon polygon;
  const glm::uvec3 vertices = scene.occluders.triangles[triangle];
  std::array<glm::dvec3, 3> corners;
  std::array<MapPoint, mostCorners + 1> points;
  for (int k = 0; k < 3; ++k)
  {
    const auto corner = static_cast<std::size_t>(k);
    corners[corner] = centredCorner(scene.occluders, surface, instance, vertices[k]);
    points[corner] = scene.space.at(corners[corner]);
  }
  const double reach = scene.lateral;
  const double nearestZ = std::min({ points[0].z, points[1].z, points[2].z });
  const double farthestZ = std::max({ points[0].z, points[1].z, points[2].z });
  if (farthestZ < scene.begins - reach && scene.box)
  {
    return polygon;
  }
  std::size_t count = 3;
  const bool apart = cutToMap(points, count, scene.space.size, scene.nearW);
  if (count < 3)
  {
    return polygon;
  }
  polygon.role.present = true;
  if (!apart)
  {
    polygon.margin = infinity;
    return polygon;
  }
  double cosine = 0.0;
  double slack = slackOf(scene, surface, instance, vertices, corners, cosine);
  if (surface.oneSided)
  {
    constexpr double unclear = 1e-5;
    if (cosine < -unclear)
    {
      polygon.role.present = false;
      return polygon;
    }
    polygon.role.covers = cosine > unclear;
  }
  else
  {
    polygon.role.covers = true;
  }
  polygon.role.covers &= !surface.cutout;

  double leastZ = infinity;
  double rate = 0.0;
  polygon.count = count;
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapPoint& p = points[i];
    polygon.corners[i] = { p.X / p.W, p.Y / p.W, p.Q / p.W };
    leastZ = std::min(leastZ, p.z);
    rate = std::max(rate, depthPerUnit(scene.space, p.W, std::max(p.z, least)));
  }
  polygon.margin = marginOf(scene, leastZ);
  polygon.slack = slack * rate;
  polygon.role.poison = leastZ < scene.begins + reach || nearestZ < scene.begins - reach;

  // Twice the area, and how high that makes it over its longest side.
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
  const bool thin = !(std::abs(area) > thinTexels * longest) || !std::isfinite(polygon.slack);
  polygon.facing = thin ? 0 : area > 0.0 ? 1 : -1;
  polygon.role.covers &= polygon.facing != 0 && !polygon.role.poison;
  if (polygon.role.poison || !polygon.role.covers)
  {
    polygon.facing = surface.cutout && !thin && !polygon.role.poison ? polygon.facing : 0;
  }
  return polygon;
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
bool segmentOf(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  const CasterEdge& edge, EdgeKind kind, MapSegment& segment)
{
  CutCorners points{ { scene.space.at(centredCorner(scene.occluders, surface, instance, edge.from)),
    scene.space.at(centredCorner(scene.occluders, surface, instance, edge.to)) } };
  std::size_t count = 2;
  // Cut as a polygon of two sides, which gives both of its ends twice.
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
  double leastZ = infinity;
  double rate = 0.0;
  segment.ends = { { corners[ends[0]], corners[ends[1]] } };
  for (const std::size_t end : ends)
  {
    const MapPoint& p = points[end];
    leastZ = std::min(leastZ, p.z);
    rate = std::max(rate, depthPerUnit(scene.space, p.W, std::max(p.z, least)));
  }
  segment.margin = marginOf(scene, leastZ);
  segment.slack = kind == EdgeKind::Unsure ? infinity : rate * scene.lateral;
  segment.isEnd = kind != EdgeKind::Sharp;
  return true;
}

} // namespace gnomon
