#include "shadowtech/conservative/WeldedVertices.h"

#include <glm/glm.hpp>
#include <tbb/parallel_sort.h>

#include <numeric>
#include <tuple>

namespace gnomon
{

//------------------------------------------------------------------------------
std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface)
{
  const glm::vec3* const positions = occluders.positionsCentred.data() + surface.firstVertex;
  std::vector<std::uint32_t> order(surface.vertexCount);
  std::iota(order.begin(), order.end(), 0u);
  // As bits, which are in order even where a vertex that no triangle has is not finite.
  const auto key = [&](std::uint32_t vertex)
  { return glm::floatBitsToUint(positions[vertex] + glm::vec3(0.0f)); }; // -0 becomes 0
  const auto less = [&](std::uint32_t a, std::uint32_t b)
  {
    const glm::uvec3 first = key(a);
    const glm::uvec3 second = key(b);
    return std::tie(first.x, first.y, first.z, a) < std::tie(second.x, second.y, second.z, b);
  };
  tbb::parallel_sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> welded(surface.vertexCount);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

} // namespace gnomon
