#pragma once

#include "lights/ShadowSettings.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/WeldedVertices.h"
#include "shadowtech/mesh/KeptOfCasters.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon
{

/// The triangles around each vertex of a surface. Vertices at exactly the same place count as one.
struct SurfaceFans
{
  std::uint32_t firstTriangle = 0; ///< of the surface
  std::vector<glm::uvec3> corners; ///< of each triangle, as welded vertices
  /// Where each vertex's fan begins in `triangles`, and the end of the last.
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> triangles; ///< counted from firstTriangle

  std::size_t bytes() const
  {
    return bytesOf(this->corners) + bytesOf(this->begin) + bytesOf(this->triangles);
  }
};

/// Update the fans of a surface. They are reused if the same vertices share a place.
/// @param fans of the same triangles at any earlier place; empty to compute everything
inline void updateFans(const Occluders& occluders, const Surface& surface, SurfaceFans& fans)
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

/// The fans of the casting surfaces, brought up to date by updateFans().
using TriangleFans = KeptOfCasters<SurfaceFans>;

/// Visit a triangle and those adjacent to it by an edge or a vertex, each once. Any number of
/// triangles may share either.
/// @param triangle number in the snapshot, as for those visited
/// @param visit returns true to stop
/// @return true if `visit` stopped
template <typename Visit>
bool visitAdjacent(
  const SurfaceFans& fans, std::uint32_t triangle, Adjacency adjacency, const Visit& visit)
{
  if (visit(triangle))
  {
    return true;
  }
  const glm::uvec3& own = fans.corners[triangle - fans.firstTriangle];
  const auto has = [](const glm::uvec3& corners, std::uint32_t vertex)
  { return corners.x == vertex || corners.y == vertex || corners.z == vertex; };
  for (int k = 0; k < 3; ++k)
  {
    for (std::uint32_t i = fans.begin[own[k]]; i != fans.begin[own[k] + 1]; ++i)
    {
      const std::uint32_t other = fans.triangles[i];
      const glm::uvec3& corners = fans.corners[other];
      const bool x = has(corners, own.x);
      const bool y = has(corners, own.y);
      const bool z = has(corners, own.z);
      const bool isFirst = k == (x ? 0 : y ? 1 : 2); // else another fan has visited it
      const bool sharesEdge = (x && y) || (y && z) || (z && x);
      if (isFirst && other + fans.firstTriangle != triangle &&
        (sharesEdge || adjacency == Adjacency::Vertices) && visit(other + fans.firstTriangle))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace gnomon
