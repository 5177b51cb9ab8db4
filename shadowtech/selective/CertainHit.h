#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/TriangleMaps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon
{

struct Occluders;

/// Return true if a triangle certainly stops a shadow ray, so that a float tracer finds it blocked,
/// too. A miss proves nothing.
///
/// The ray O + t D is tested in double precision, relative to O. Let u = 2^-24, R the magnitude of
/// O and of the farthest corner, h the longest edge, and N the cross product of two edges. A float
/// tracer moves edge functions by up to 2 sqrt(3) u R |D| h, and rounds their sums by less than 24
/// u R h |D|; it rounds v0.N and N.D to less than 24 u R h^2 and 24 u h^2 |D|. A hit counts if all
/// of them exceed 64 u (docs/theory/blockers.md). Rays of instances are rounded again, by up to 8
/// times as much (instanceNoise() of ShadowRay.h, with a skewness of 2).
///
/// Triangles with a cut-out never count, as the ray may go through a hole. One-sided triangles
/// count by their front only.
inline bool certainlyStops(
  const Occluders& occluders, const CasterTriangle& caster, const ShadowRay& ray, float rayFar)
{
  const Surface& surface = occluders.surfaces[caster.surface];
  if (surface.cutout)
  {
    return false;
  }
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 direction(ray.direction);
  std::array<glm::dvec3, 3> v =
    centredCorners(occluders, surface, caster.instance, caster.triangle);
  for (glm::dvec3& corner : v)
  {
    corner -= origin;
  }

  double reach =
    std::max({ glm::length(v[0]), glm::length(v[1]), glm::length(v[2]) }) + glm::length(origin);
  if (surface.isInstanced())
  {
    reach = 8.0 * (reach + glm::length(glm::dvec3(surface.centredFromSource[caster.instance][3])));
  }
  const double longest =
    std::max({ glm::length(v[1] - v[0]), glm::length(v[2] - v[1]), glm::length(v[0] - v[2]) });
  const double length = glm::length(direction);
  const double rounding = std::ldexp(longest, -18); // 64 u h

  const double edges[] = { glm::dot(glm::cross(v[1], v[2]), direction),
    glm::dot(glm::cross(v[2], v[0]), direction), glm::dot(glm::cross(v[0], v[1]), direction) };
  // Orient the triangle such that the ray leaves through its front.
  const double side = edges[0] > 0.0 ? 1.0 : -1.0;
  const double least = rounding * reach * length;
  // NaN must fail, and so must triangles without area, whose functions are 0.
  const auto isInside = [&](double edge) { return side * edge > least; };
  if (!(isInside(edges[0]) && isInside(edges[1]) && isInside(edges[2])) ||
    (surface.oneSided && side < 0.0))
  {
    return false;
  }

  const glm::dvec3 normal = side * glm::cross(v[1] - v[0], v[2] - v[0]);
  const double start = glm::dot(normal, v[0]);
  if (!std::isfinite(rayFar))
  {
    return start > rounding * longest * reach;
  }
  const double end = rayFar * length;
  const double noise = rounding * longest * (reach + end);
  return start > noise && rayFar * glm::dot(normal, direction) - start > noise;
}

} // namespace gnomon
