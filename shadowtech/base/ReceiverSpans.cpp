#include "shadowtech/base/ReceiverSpans.h"

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/SmoothFacet.h"

#include <algorithm>
#include <array>

namespace gnomon
{
namespace
{

/// Find where the rays meet the triangle; `inside` is 0 for rays that miss it.
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void meetSpan(const SeenTriangle& seen,
  const PixelRays& rays, const PixelSpan& span, ReceiverPixels& receivers, std::uint8_t* inside)
{
  const double y = span.y;
  const auto component = [&](const glm::dvec3& first, const glm::dvec3& perColumn,
                           const glm::dvec3& perRow, int axis) {
    return AffineOverRow{ first[axis] + y * perRow[axis], perColumn[axis] };
  };
  const auto origin = [&](int axis)
  { return component(rays.firstOrigin, rays.originPerColumn, rays.originPerRow, axis); };
  const auto direction = [&](int axis)
  { return component(rays.firstDirection, rays.directionPerColumn, rays.directionPerRow, axis); };
  const AffineOverRow originX = origin(0), originY = origin(1), originZ = origin(2);
  const AffineOverRow directionX = direction(0), directionY = direction(1),
                      directionZ = direction(2);
  const AffineOverRow planeDistance = seen.planeDistance.row(y);
  const AffineOverRow alongNormal = seen.alongNormal.row(y);
  const AffineOverRow edge0 = seen.insideEdge[0].row(y);
  const AffineOverRow edge1 = seen.insideEdge[1].row(y);
  const AffineOverRow edge2 = seen.insideEdge[2].row(y);
  // A pixel's side is one of these times 1 or t; the other is 0.
  const double sideParallel = glm::length(rays.originPerRow);
  const double sidePerDepth = glm::length(rays.directionPerRow);

  float* const positionX = &receivers.positionX[span.first];
  float* const positionY = &receivers.positionY[span.first];
  float* const positionZ = &receivers.positionZ[span.first];
  float* const offset = &receivers.offset[span.first];
  const double firstX = span.x;
  const auto count = static_cast<int>(span.count);
  const float noise = seen.noise;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
  {
    const double x = firstX + i;
    const double along = alongNormal.at(x);
    const double t = planeDistance.at(x) / along;
    positionX[i] = static_cast<float>(originX.at(x) + t * directionX.at(x));
    positionY[i] = static_cast<float>(originY.at(x) + t * directionY.at(x));
    positionZ[i] = static_cast<float>(originZ.at(x) + t * directionZ.at(x));
    offset[i] = shadowRayOffsetInside(noise, static_cast<float>(sideParallel + t * sidePerDepth));
    // Written so that NaN fails.
    inside[i] = (edge0.at(x) >= 0.0) & (edge1.at(x) >= 0.0) & (edge2.at(x) >= 0.0) & (along > 0.0);
  }
}

} // namespace

void projectFlat(
  const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span, ReceiverPixels& receivers)
{
  std::array<std::uint8_t, ReceiverTile::mostColumns> inside;
  meetSpan(seen, rays, span, receivers, inside.data());
  const std::size_t first = span.first;
  const std::size_t count = span.count;
  std::fill_n(&receivers.normalX[first], count, seen.normal.x);
  std::fill_n(&receivers.normalY[first], count, seen.normal.y);
  std::fill_n(&receivers.normalZ[first], count, seen.normal.z);
  std::fill_n(&receivers.surface[first], count, seen.surface);
  std::fill_n(&receivers.curved[first], count, 0);
  for (std::size_t j = 0; j < count; ++j)
  {
    if (inside[j])
    {
      continue;
    }
    const double x = span.x + static_cast<double>(j);
    const glm::dvec3 origin = rays.origin(x, span.y);
    const glm::dvec3 direction = rays.direction(x, span.y);
    const glm::dvec3 edge = closestToRay(seen.corners, origin, direction, rays.parallel());
    const double t = glm::dot(edge - origin, direction) / glm::dot(direction, direction);
    const double footprint = glm::length(rays.originPerRow + t * rays.directionPerRow);
    const glm::dvec3 position = inwards(edge, seen.corners, footprint);
    const glm::vec3 normal =
      seen.normal == glm::vec3(0.0f) ? glm::vec3(-glm::normalize(direction)) : seen.normal;
    receivers.put(first + j, position, normal,
      shadowRayOffset(seen.noise, static_cast<float>(footprint)), seen.surface);
  }
}

void findCurves(const SeenTriangle& seen, const PixelSpan& span, ReceiverPixels& receivers)
{
  using Row = std::array<float, ReceiverTile::mostColumns>;
  const std::size_t first = span.first;
  Row heights, normalX, normalY, normalZ;
  SmoothFacet(seen.corners, *seen.smoothNormals)
    .look(span.count,
      { &receivers.positionX[first], &receivers.positionY[first], &receivers.positionZ[first] },
      heights.data(), { normalX.data(), normalY.data(), normalZ.data() });
  std::fill_n(&receivers.curved[first], span.count, 1);
  for (std::size_t i = 0; i < span.count; ++i)
  {
    receivers.curves[first + i] = { { normalX[i], normalY[i], normalZ[i] }, heights[i],
      seen.found.triangle, seen.found.instance };
  }
}

void projectSolid(
  const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span, ReceiverPixels& receivers)
{
  for (std::size_t j = 0; j < span.count; ++j)
  {
    const double x = span.x + static_cast<double>(j);
    const glm::dvec3 origin = rays.origin(x, span.y);
    const glm::dvec3 direction = rays.direction(x, span.y);
    const SolidPoint point = seenPoint(*seen.solid, origin, direction);
    const double t = glm::dot(point.position - origin, direction) / glm::dot(direction, direction);
    const auto footprint =
      static_cast<float>(glm::length(rays.originPerRow + t * rays.directionPerRow));
    const float noise = noiseOf(*seen.solid, point);
    receivers.put(span.first + j, point.position, point.normal,
      point.isMet ? shadowRayOffsetInside(noise, footprint) : shadowRayOffset(noise, footprint),
      seen.surface);
  }
}

void projectSpan(
  const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span, ReceiverPixels& receivers)
{
  projectFlat(seen, rays, span, receivers);
  if (seen.smoothNormals)
  {
    findCurves(seen, span, receivers);
  }
}

void leaveUncovered(const PixelSpan& span, ReceiverPixels& receivers)
{
  for (const auto plane : ReceiverPixels::planes)
  {
    std::fill_n(&(receivers.*plane)[span.first], span.count, 0.0f);
  }
  std::fill_n(&receivers.surface[span.first], span.count, ReceiverPixels::notCovered);
  std::fill_n(&receivers.curved[span.first], span.count, 0);
}

} // namespace gnomon
