#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon
{

/// @file
/// The snapshot's triangles in centred coordinates and double precision, with or without instances.

/// Return a vertex in centred coordinates.
/// @param instance of a surface with instances; else ignored
inline glm::dvec3 centredVertex(
  const Occluders& occluders, const Surface& surface, std::uint32_t instance, std::uint32_t vertex)
{
  const glm::dvec3 position = occluders.positionsCentred[vertex];
  return surface.isInstanced()
    ? glm::dmat4x3(surface.centredFromSource[instance]) * glm::dvec4(position, 1.0)
    : position;
}

inline std::array<glm::dvec3, 3> centredCorners(const Occluders& occluders, const Surface& surface,
  std::uint32_t instance, std::uint32_t triangle)
{
  const glm::uvec3 vertices = occluders.triangles[triangle];
  return { centredVertex(occluders, surface, instance, vertices.x),
    centredVertex(occluders, surface, instance, vertices.y),
    centredVertex(occluders, surface, instance, vertices.z) };
}

/// Return how far off its plane a triangle's points may seem to lie: planeNoise(), plus
/// instanceNoise() of an instance.
/// @param corners centred
/// @param normal unit length
/// @param doubleArea twice its area; > 0; infinity gives the share that does not depend on it
inline float noiseOf(const Occluders& occluders, const Surface& surface, std::uint32_t instance,
  std::uint32_t triangle, const std::array<glm::dvec3, 3>& corners, const glm::vec3& normal,
  double doubleArea)
{
  const auto& [a, b, c] = corners;
  const glm::vec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const glm::vec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  const float noise = planeNoise(normal, largest, extent, static_cast<float>(doubleArea));
  if (!surface.isInstanced())
  {
    return noise;
  }
  const glm::uvec3 vertices = occluders.triangles[triangle];
  return noise +
    instanceNoise(normal, corners,
      { occluders.positionsCentred[vertices.x], occluders.positionsCentred[vertices.y],
        occluders.positionsCentred[vertices.z] },
      surface.centredFromSource[instance], doubleArea);
}

} // namespace gnomon
