#include "shadowtech/selective/TriangleFans.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/conservative/WeldedVertices.h"

namespace gnomon
{

//------------------------------------------------------------------------------
SurfaceFans findFans(const Occluders& occluders, const Surface& surface)
{
  const std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
  SurfaceFans fans;
  fans.firstTriangle = surface.firstTriangle;
  fans.corners.reserve(surface.triangleCount);
  fans.begin.assign(static_cast<std::size_t>(surface.vertexCount) + 1, 0);
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i] - surface.firstVertex;
    fans.corners.emplace_back(welded[corners.x], welded[corners.y], welded[corners.z]);
    for (int k = 0; k < 3; ++k)
    {
      ++fans.begin[fans.corners.back()[k]];
    }
  }
  // From how many there are to where each one's end, and from there down to where they begin.
  std::uint32_t end = 0;
  for (std::uint32_t& begin : fans.begin)
  {
    begin = end += begin;
  }
  fans.triangles.resize(end);
  for (std::uint32_t i = surface.triangleCount; i-- > 0;)
  {
    for (int k = 0; k < 3; ++k)
    {
      fans.triangles[--fans.begin[fans.corners[i][k]]] = i;
    }
  }
  return fans;
}

//------------------------------------------------------------------------------
std::size_t TriangleFans::bytes() const
{
  return this->kept_.bytes([](const SurfaceFans& found)
    { return bytesOf(found.corners) + bytesOf(found.begin) + bytesOf(found.triangles); });
}

} // namespace gnomon
