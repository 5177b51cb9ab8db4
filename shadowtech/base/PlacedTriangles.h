#pragma once

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon
{

/// @file
/// The snapshot's triangles where they stand, in double precision, whether their surface is there
/// once or as instances.

/// A vertex, centred.
/// @param instance of a surface with instances; else of no meaning
inline glm::dvec3 centredVertex(
  const Occluders& occluders, const Surface& surface, std::uint32_t instance, std::uint32_t vertex)
{
  const glm::dvec3 position = occluders.positionsCentred[vertex];
  return surface.isInstanced()
    ? glm::dmat4x3(surface.centredFromSource[instance]) * glm::dvec4(position, 1.0)
    : position;
}

/// A triangle's corners, centred.
inline std::array<glm::dvec3, 3> centredCorners(const Occluders& occluders, const Surface& surface,
  std::uint32_t instance, std::uint32_t triangle)
{
  const glm::uvec3 vertices = occluders.triangles[triangle];
  return { centredVertex(occluders, surface, instance, vertices.x),
    centredVertex(occluders, surface, instance, vertices.y),
    centredVertex(occluders, surface, instance, vertices.z) };
}

/// How far from its plane the points of a triangle may seem to lie: planeNoise(), and
/// instanceNoise() where it is one.
/// @param corners centred
/// @param normal unit length
/// @param doubleArea twice its area; > 0, infinite for the share that does not depend on it
float noiseOf(const Occluders& occluders, const Surface& surface, std::uint32_t instance,
  std::uint32_t triangle, const std::array<glm::dvec3, 3>& corners, const glm::vec3& normal,
  double doubleArea);

} // namespace gnomon
