#include "shadowtech/mesh/TriangleFans.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/WeldedVertices.h"

#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
void updateFans(const Occluders& occluders, const Surface& surface, SurfaceFans& fans)
{
  fans.firstTriangle = surface.firstTriangle;
  const std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
  std::vector<glm::uvec3> triangles(surface.triangleCount);
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i] - surface.firstVertex;
    triangles[i] = { welded[corners.x], welded[corners.y], welded[corners.z] };
  }
  if (triangles == fans.corners)
  {
    return;
  }
  fans.corners = std::move(triangles);
  fans.begin.assign(static_cast<std::size_t>(surface.vertexCount) + 1, 0);
  for (const glm::uvec3& corners : fans.corners)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++fans.begin[corners[k]];
    }
  }
  // Turn counts into each fan's end. Filling in triangles then moves these down to the begins.
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
}

//------------------------------------------------------------------------------
std::size_t SurfaceFans::bytes() const
{
  return bytesOf(this->corners) + bytesOf(this->begin) + bytesOf(this->triangles);
}

} // namespace gnomon
