#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Solid.h"
#include "shadowtech/tracing/CasterHits.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// A receiver where a ray of the camera meets a caster.
struct SeenReceiver
{
  glm::vec3 position;
  glm::vec3 normal; ///< unit length, on the camera's side
  float noise;      ///< for shadowRayOffset()
};

/// Return the receiver at a hit.
/// @param origin, direction of the camera's ray
inline SeenReceiver seenReceiver(const CasterHits::Hit& hit, const glm::dvec3& origin,
  const glm::dvec3& direction, const glm::dvec3& eyeCentred)
{
  if (hit.solid)
  {
    const SolidPoint point = seenPoint(*hit.solid, origin, direction);
    return { glm::vec3(point.position), glm::vec3(point.normal), noiseOf(*hit.solid, point) };
  }
  const glm::vec3 position(origin + static_cast<double>(hit.at) * direction);
  glm::vec3 normal = glm::normalize(hit.normalCentred);
  normal = glm::dot(normal, glm::vec3(direction)) > 0.0f ? -normal : normal;
  // Rounding of the ray and of its length is of the size of the storage noise.
  return { position, normal,
    4.0f * storageNoise(normal, glm::abs(position) + glm::abs(glm::vec3(eyeCentred))) };
}

} // namespace gnomon
