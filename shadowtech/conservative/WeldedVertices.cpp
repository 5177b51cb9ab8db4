#include "shadowtech/conservative/WeldedVertices.h"

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
  const auto less = [&](std::uint32_t a, std::uint32_t b)
  {
    const Place first = placeOf(positions[a]);
    const Place second = placeOf(positions[b]);
    return std::tie(first, a) < std::tie(second, b);
  };
  tbb::parallel_sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> welded(surface.vertexCount);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool same = i > 0 && placeOf(positions[order[i]]) == placeOf(positions[order[i - 1]]);
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

} // namespace gnomon
