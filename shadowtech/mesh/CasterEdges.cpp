#include "shadowtech/mesh/CasterEdges.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/WeldedVertices.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace gnomon
{
namespace
{

/// The least cosine between a normal around a vertex and the mean normal there: half of the angle
/// of sharpCosine.
const double sharpCosineToMean = std::sqrt(0.5 * (1.0 + sharpCosine));

/// One side of a triangle.
struct Side
{
  std::uint32_t lesser, greater; ///< its ends, as welded vertices
  std::uint32_t triangle;
  std::uint8_t corner; ///< corner where it starts; it runs to the next corner
  bool reversed;       ///< true if it runs from the greater end to the lesser one

  bool operator<(const Side& other) const
  {
    return std::tie(this->lesser, this->greater, this->triangle, this->corner) <
      std::tie(other.lesser, other.greater, other.triangle, other.corner);
  }
  bool hasEndsOf(const Side& other) const
  {
    return this->lesser == other.lesser && this->greater == other.greater;
  }
};

/// Return the sides of all triangles of a surface, sorted.
/// @param welded for each vertex, the vertex that represents its place (weldedVertices())
std::vector<Side> sortedSides(
  const Occluders& occluders, const Surface& surface, const std::vector<std::uint32_t>& welded)
{
  const auto visit = [&](auto&& visitSide)
  {
    for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
    {
      const glm::uvec3 corners =
        occluders.triangles[surface.firstTriangle + i] - surface.firstVertex;
      for (int k = 0; k < 3; ++k)
      {
        const std::uint32_t from = welded[corners[k]];
        const std::uint32_t to = welded[corners[(k + 1) % 3]];
        visitSide(Side{ std::min(from, to), std::max(from, to), surface.firstTriangle + i,
          static_cast<std::uint8_t>(k), from > to });
      }
    }
  };
  // Bucket the sides by their lesser ends first: few sides share one.
  std::vector<std::uint32_t> end(static_cast<std::size_t>(surface.vertexCount) + 1, 0);
  visit([&](const Side& side) { ++end[side.lesser + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Side> sides(end.back());
  visit([&](const Side& side) { sides[end[side.lesser]++] = side; });
  tbb::parallel_for(std::uint32_t(0), surface.vertexCount,
    [&](std::uint32_t i)
    { std::sort(sides.begin() + (i > 0 ? end[i - 1] : 0), sides.begin() + end[i]); });
  return sides;
}

/// Return unit normals; zero for triangles too thin for shadow rays that start on their neighbours.
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

/// Return, by welded vertex, the least cosine between a normal around it and the normals' axis. The
/// sign of either does not matter.
std::vector<float> leastCosines(const Occluders& occluders, const Surface& surface,
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
  // Signs of normals do not matter here, as triangles may be wound either way. Where no neighbours
  // are sharp, all normals around a corner lie on one side of the sum, or far from their mean.
  std::vector<glm::dvec3> axes(surface.vertexCount, glm::dvec3(0.0));
  visit([&](std::uint32_t vertex, const glm::dvec3& normal)
    { axes[vertex] += glm::dot(normal, axes[vertex]) < 0.0 ? -normal : normal; });
  std::vector<float> cosines(surface.vertexCount, -1.0f);
  for (std::size_t i = 0; i < cosines.size(); ++i)
  {
    const double length = glm::length(axes[i]);
    if (length > 0.0)
    {
      axes[i] /= length;
      cosines[i] = 1.0f;
    }
  }
  visit(
    [&](std::uint32_t vertex, const glm::dvec3& normal)
    {
      float& least = cosines[vertex];
      least = std::min(least, static_cast<float>(std::abs(glm::dot(normal, axes[vertex]))));
    });
  return cosines;
}

/// Join triangles at the edges they share: sides with the same ends.
SurfaceEdges joinTriangles(
  const Occluders& occluders, const Surface& surface, std::vector<std::uint32_t> welded)
{
  SurfaceEdges found;
  found.welded = std::move(welded);
  const std::vector<Side> sides = sortedSides(occluders, surface, found.welded);
  found.ofTriangle.resize(surface.triangleCount);
  std::vector<CasterEdge>& edges = found.edges;
  const auto noteNext = [&](const Side& side)
  {
    found.ofTriangle[side.triangle - surface.firstTriangle][side.corner] =
      static_cast<std::uint32_t>(edges.size());
  };
  edges.reserve(sides.size() / 2 + sides.size() / 16);
  for (std::size_t first = 0; first < sides.size();)
  {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].hasEndsOf(sides[first]))
    {
      ++last;
    }
    CasterEdge edge;
    edge.from = surface.firstVertex + sides[first].lesser;
    edge.to = surface.firstVertex + sides[first].greater;
    if (last - first == 2)
    {
      edge.triangles = { { sides[first].triangle, sides[first + 1].triangle } };
      edge.sameDirection = sides[first].reversed == sides[first + 1].reversed;
      noteNext(sides[first]);
      noteNext(sides[first + 1]);
      edges.push_back(edge);
    }
    else
    {
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
  return found;
}

/// Shift vertex and triangle numbers to the surface's present place in the snapshot.
void renumber(const Surface& surface, SurfaceEdges& found)
{
  // Unsigned differences modulo 2^32 also hold negative shifts.
  const std::uint32_t vertices = surface.firstVertex - found.firstVertex;
  const std::uint32_t triangles = surface.firstTriangle - found.firstTriangle;
  if (vertices == 0 && triangles == 0)
  {
    return;
  }
  for (CasterEdge& edge : found.edges)
  {
    edge.from += vertices;
    edge.to += vertices;
    for (std::uint32_t& triangle : edge.triangles)
    {
      triangle += triangle == CasterEdge::none ? 0 : triangles;
    }
  }
}

/// Classify edges as sharp or not.
void findSharp(const Occluders& occluders, const Surface& surface, SurfaceEdges& found)
{
  const std::vector<glm::dvec3> normals = normalsOf(occluders, surface);
  const std::vector<float> cosines = leastCosines(occluders, surface, found.welded, normals);
  // NaN must count as sharp.
  const auto isSharp = [&](std::uint32_t vertex)
  { return !(cosines[vertex - surface.firstVertex] > sharpCosineToMean); };
  const auto normalOf = [&](std::uint32_t triangle) -> const glm::dvec3&
  { return normals[triangle - surface.firstTriangle]; };
  tbb::parallel_for(std::size_t(0), found.edges.size(),
    [&](std::size_t i)
    {
      CasterEdge& edge = found.edges[i];
      // Instances may be sheared, which changes angles.
      if (edge.triangles[1] == CasterEdge::none || surface.isInstanced())
      {
        edge.sharp = true;
        return;
      }
      const double cosine = (edge.sameDirection ? -1.0 : 1.0) *
        glm::dot(normalOf(edge.triangles[0]), normalOf(edge.triangles[1]));
      edge.sharp = !(cosine > sharpCosine) || isSharp(edge.from) || isSharp(edge.to);
    });
}

} // namespace

void updateCasterEdges(const Occluders& occluders, const Surface& surface, SurfaceEdges& edges)
{
  std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
  if (welded != edges.welded)
  {
    edges = joinTriangles(occluders, surface, std::move(welded));
  }
  else
  {
    renumber(surface, edges);
  }
  edges.firstVertex = surface.firstVertex;
  edges.firstTriangle = surface.firstTriangle;
  findSharp(occluders, surface, edges);
}

std::size_t SurfaceEdges::bytes() const
{
  return bytesOf(this->edges) + bytesOf(this->ofTriangle) + bytesOf(this->welded);
}

void CasterEdges::update(const Occluders& occluders)
{
  if (this->versions_ == occluders.versions())
  {
    return;
  }
  this->kept_.update(occluders, updateCasterEdges);
  this->joinParts(occluders);
  this->versions_ = occluders.versions();
}

void CasterEdges::joinParts(const Occluders& occluders)
{
  this->parts_.resize(occluders.triangles.size());
  std::iota(this->parts_.begin(), this->parts_.end(), 0u);
  // Union-find: each triangle points to a lesser one of its part, the least to itself.
  const auto leastOf = [this](std::uint32_t triangle)
  {
    while (this->parts_[triangle] != triangle)
    {
      triangle = this->parts_[triangle] = this->parts_[this->parts_[triangle]];
    }
    return triangle;
  };
  const auto join = [&](std::uint32_t one, std::uint32_t other)
  {
    const std::uint32_t a = leastOf(one);
    const std::uint32_t b = leastOf(other);
    this->parts_[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    if (!occluders.surfaces[i].casts)
    {
      continue;
    }
    for (const CasterEdge& edge : this->of(i).edges)
    {
      if (edge.triangles[1] != CasterEdge::none)
      {
        join(edge.triangles[0], edge.triangles[1]);
      }
    }
  }
  for (std::uint32_t& part : this->parts_)
  {
    part = this->parts_[part]; // the lesser ones already point to their least
  }
}

std::size_t CasterEdges::bytes() const
{
  return bytesOf(this->parts_) + this->kept_.bytes();
}

} // namespace gnomon
