#pragma once

#include "lights/LightArea.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/mesh/CasterBands.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon
{

/// How far rounding may move a ray's end off a caster's plane, over the largest centred coordinate.
/// It is the bound of planeNoise() (ShadowRay.h) for triangles that are no slivers.
inline constexpr double rounding = 1.9073486328125e-6; // 2^-19

using Corners = std::array<glm::dvec3, 3>;

/// Return the distance of a point in a triangle's plane from the triangle.
/// @param normal of any length
inline double distanceInPlane(
  const Corners& corners, const glm::dvec3& normal, const glm::dvec3& point)
{
  bool isInside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    const glm::dvec3 way = point - corners[i];
    isInside = isInside && glm::dot(glm::cross(edge, way), normal) >= 0.0;
    const double share = std::clamp(glm::dot(way, edge) / glm::dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(way, share * edge));
  }
  return isInside ? 0.0 : nearest;
}

/// Return true if a light lies in a triangle.
/// @param noise how far off its plane rounding may move a triangle's points, in world units
inline bool liesIn(
  const Corners& corners, const glm::dvec3& position, const LightArea* area, double noise)
{
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  // Triangles of instances may have no area, and so no plane; these stop no ray.
  if (!(length > 0.0) || std::abs(glm::dot(normal, position - corners[0])) > noise * length)
  {
    return false;
  }
  const bool isCoplanar = !area || area->extentAlong(normal / length) <= noise;
  const double reach = area ? area->radius() : 0.0;
  return isCoplanar && distanceInPlane(corners, normal, position) <= reach + noise;
}

/// Return true if a positional light lies in a caster: on one of its triangles, to within rounding.
///
/// Shadow rays to this light end on the triangle. Its maps see the triangle edge-on, and so miss
/// it. An area lies in a triangle if it is flat, coplanar with it, and no farther than its radius.
/// A light that crosses a caster does not lie in it, as either side sees the caster.
/// @param positionCentred the light's centre
/// @param area around it, in world units; null for a point light
inline bool liesInCaster(
  const glm::dvec3& positionCentred, const LightArea* area, const Occluders& occluders)
{
  glm::dvec3 largest = glm::abs(positionCentred);
  for (const glm::dvec3& corner : occluders.allCentred.corners())
  {
    largest = glm::max(largest, glm::abs(corner));
  }
  const double noise = rounding * std::max(largest.x, std::max(largest.y, largest.z));
  const CasterPlacements placements(occluders);
  std::atomic<bool> found{ false };
  placements.visitTriangles(
    [&](std::uint32_t number, std::uint32_t triangle)
    {
      const Placement& placement = placements[number];
      if (!found.load(std::memory_order_relaxed) &&
        liesIn(
          centredCorners(occluders, placements.surfaceOf(placement), placement.instance, triangle),
          positionCentred, area, noise))
      {
        found = true;
      }
    });
  return found;
}

} // namespace gnomon
