#include "shadowtech/base/PlacedTriangles.h"

#include "shadowtech/base/ShadowRay.h"

namespace gnomon
{

//------------------------------------------------------------------------------
float noiseOf(const Occluders& occluders, const Surface& surface, std::uint32_t instance,
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
