#include "shadowtech/conservative/CasterEdges.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/conservative/WeldedVertices.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gnomon
{
namespace
{

/// Of half that angle: the normals around a vertex are that close to their mean.
const double sharpCosineToMean = std::sqrt(0.5 * (1.0 + sharpCosine));

/// One side of a triangle, by its ends in increasing order.
struct Side
{
  std::uint64_t ends; ///< the smaller one first
  std::uint32_t triangle;
  std::uint8_t corner; ///< it runs from this corner to the next
  bool reversed;

  bool operator<(const Side& other) const
  {
    return std::tie(this->ends, this->triangle, this->corner) <
      std::tie(other.ends, other.triangle, other.corner);
  }
};

/// Unit normals; zero of triangles that are too thin for shadow rays that start on their neighbours.
std::vector<glm::dvec3> normalsOf(const Occluders& occluders, const Surface& surface)
{
  std::vector<glm::dvec3> normals(surface.triangleCount);
  tbb::parallel_for(std::uint32_t(0), surface.triangleCount,
    [&](std::uint32_t i)
    {
      const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i];
      const glm::dvec3 a = occluders.positionsCentred[corners.x];
      const glm::dvec3 b = occluders.positionsCentred[corners.y];
      const glm::dvec3 c = occluders.positionsCentred[corners.z];
      const glm::dvec3 area = glm::cross(b - a, c - a);
      const double doubleArea = glm::length(area);
      const double longest =
        std::max({ glm::length(b - a), glm::length(c - b), glm::length(a - c) });
      const glm::dvec3 largest = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
      // Offsets of shadow rays are a few times the rounding of coordinates.
      const double rounding = std::ldexp(1.0, -17) * std::max({ largest.x, largest.y, largest.z });
      const bool thin = !(doubleArea > rounding * longest);
      normals[i] = thin ? glm::dvec3(0.0) : area / doubleArea;
    });
  return normals;
}

/// Which vertices have triangles around them whose normals are too far apart.
std::vector<std::uint8_t> sharpVertices(const Occluders& occluders, const Surface& surface,
  const std::vector<std::uint32_t>& welded, const std::vector<glm::dvec3>& normals)
{
  const auto visit = [&](auto&& visitCorner)
  {
    for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
    {
      const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i];
      for (int k = 0; k < 3; ++k)
      {
        visitCorner(welded[corners[k] - surface.firstVertex], normals[i]);
      }
    }
  };
  std::vector<glm::dvec3> means(surface.vertexCount, glm::dvec3(0.0));
  // Which side a normal is on does not matter here, as triangles may be wound either way: where neighbours are no
  // sharper than that, all around a corner are on one side, or far from the mean.
  visit([&](std::uint32_t vertex, const glm::dvec3& normal)
    { means[vertex] += glm::dot(normal, means[vertex]) < 0.0 ? -normal : normal; });
  std::vector<std::uint8_t> sharp(surface.vertexCount, 0);
  visit(
    [&](std::uint32_t vertex, const glm::dvec3& normal)
    {
      const glm::dvec3& mean = means[vertex];
      // Written so that the zero normal is sharp.
      if (!(std::abs(glm::dot(normal, mean)) > sharpCosineToMean * glm::length(mean)))
      {
        sharp[vertex] = 1;
      }
    });
  return sharp;
}

} // namespace

//------------------------------------------------------------------------------
SurfaceEdges findCasterEdges(const Occluders& occluders, const Surface& surface)
{
  const std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
  std::vector<Side> sides(3 * static_cast<std::size_t>(surface.triangleCount));
  tbb::parallel_for(std::uint32_t(0), surface.triangleCount,
    [&](std::uint32_t i)
    {
      const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i];
      for (int k = 0; k < 3; ++k)
      {
        const std::uint64_t from = welded[corners[k] - surface.firstVertex];
        const std::uint64_t to = welded[corners[(k + 1) % 3] - surface.firstVertex];
        sides[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)] = {
          std::min(from, to) << 32 | std::max(from, to), surface.firstTriangle + i,
          static_cast<std::uint8_t>(k), from > to
        };
      }
    });
  tbb::parallel_sort(sides.begin(), sides.end());

  const std::vector<glm::dvec3> normals = normalsOf(occluders, surface);
  const std::vector<std::uint8_t> sharp = sharpVertices(occluders, surface, welded, normals);
  const auto normalOf = [&](std::uint32_t triangle) -> const glm::dvec3&
  { return normals[triangle - surface.firstTriangle]; };

  SurfaceEdges result;
  result.ofTriangle.resize(surface.triangleCount);
  std::vector<CasterEdge>& edges = result.edges;
  const auto noteNext = [&](const Side& side)
  {
    result.ofTriangle[side.triangle - surface.firstTriangle][side.corner] =
      static_cast<std::uint32_t>(edges.size());
  };
  edges.reserve(sides.size() / 2 + sides.size() / 16);
  for (std::size_t first = 0; first < sides.size();)
  {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].ends == sides[first].ends)
    {
      ++last;
    }
    CasterEdge edge;
    edge.from = surface.firstVertex + static_cast<std::uint32_t>(sides[first].ends >> 32);
    edge.to = surface.firstVertex + static_cast<std::uint32_t>(sides[first].ends);
    if (last - first == 2)
    {
      edge.triangles = { { sides[first].triangle, sides[first + 1].triangle } };
      edge.sameDirection = sides[first].reversed == sides[first + 1].reversed;
      // Instances may be sheared, which changes angles.
      const double cosine = (edge.sameDirection ? -1.0 : 1.0) *
        glm::dot(normalOf(edge.triangles[0]), normalOf(edge.triangles[1]));
      edge.sharp = surface.isInstanced() || !(cosine > sharpCosine) ||
        sharp[edge.from - surface.firstVertex] || sharp[edge.to - surface.firstVertex];
      noteNext(sides[first]);
      noteNext(sides[first + 1]);
      edges.push_back(edge);
    }
    else
    {
      edge.sharp = true;
      for (std::size_t i = first; i < last; ++i)
      {
        edge.triangles[0] = sides[i].triangle;
        noteNext(sides[i]);
        edges.push_back(edge);
      }
    }
    first = last;
  }
  edges.shrink_to_fit();
  return result;
}

//------------------------------------------------------------------------------
void CasterEdges::update(const Occluders& occluders)
{
  this->kept_.update(occluders, findCasterEdges);
}

//------------------------------------------------------------------------------
std::size_t CasterEdges::bytes() const
{
  return this->kept_.bytes(
    [](const SurfaceEdges& found) { return bytesOf(found.edges) + bytesOf(found.ofTriangle); });
}

} // namespace gnomon
