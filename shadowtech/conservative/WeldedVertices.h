#ifndef gnomon_shadowtech_conservative_WeldedVertices_h
#define gnomon_shadowtech_conservative_WeldedVertices_h

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// A position as bits: in order even where it is not finite, and the same only for exactly the same place.
using Place = std::array<std::uint32_t, 3>;

inline Place placeOf(const glm::vec3& position)
{
  const glm::uvec3 bits = glm::floatBitsToUint(position + glm::vec3(0.0f)); // -0 becomes 0
  return { { bits.x, bits.y, bits.z } };
}

/// For each vertex of a surface, counted from its first, the first one at exactly the same place: surfaces
/// that are drawn are split where their normals or texture coordinates break.
std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface);

} // namespace gnomon

#endif
