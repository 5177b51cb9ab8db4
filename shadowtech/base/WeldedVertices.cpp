#include "shadowtech/base/WeldedVertices.h"

namespace gnomon
{

//------------------------------------------------------------------------------
std::vector<std::uint32_t> weldedVertices(const Occluders& occluders, const Surface& surface)
{
  const glm::vec3* const positions = occluders.positionsCentred.data() + surface.firstVertex;
  std::vector<std::uint32_t> welded(surface.vertexCount);
  FirstOfSame first(welded.size());
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    const Place place = placeOf(positions[i]);
    welded[i] = first.of(
      i, hashOf(place), [&](std::uint32_t other) { return placeOf(positions[other]) == place; });
  }
  return welded;
}

} // namespace gnomon
