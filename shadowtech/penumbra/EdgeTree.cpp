#include "shadowtech/penumbra/EdgeTree.h"

#include "shadowtech/base/Bytes.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon
{
namespace
{

/// The ratio of length to height beyond which triangles are needles. Rounding decides what a tracer
/// finds of a needle.
constexpr double mostSlender = 16384.0;

/// Bounds rounding of v . N, for a triangle's normal N, and v a direction or a vector from one of
/// its corners. It is twice the bound of docs/theory/shadow_ray.md, which is 11u YZ per unit of x,
/// with Y and Z sides of its box.
constexpr double noiseOfExtent = 22.0 / 16777216.0;

/// Levels of the tree whose halves are fitted in parallel.
constexpr int levelsInParallel = 8;

EdgeTriangle edgeTriangle(const std::array<glm::vec3, 3>& corners, bool oneSided)
{
  const glm::dvec3 a = corners[0];
  const glm::dvec3 b = corners[1];
  const glm::dvec3 c = corners[2];
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double longest = std::max({ glm::length(b - a), glm::length(c - b), glm::length(a - c) });
  const glm::dvec3 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
  // The snapshot holds no triangles without area.
  EdgeTriangle triangle;
  triangle.normal = normal / longest;
  triangle.corner = corners[0];
  triangle.height = static_cast<float>(glm::length(normal) / longest);
  triangle.longest = static_cast<float>(longest);
  triangle.unsure = noiseOfExtent / longest *
    glm::dvec3(extent.y * extent.z, extent.z * extent.x, extent.x * extent.y);
  triangle.noise = glm::dot(triangle.unsure, glm::vec3(extent));
  triangle.oneSided = oneSided;
  return triangle;
}

/// Return a cone around both; it is undefined if one of them is.
EdgeTree::Cone joined(const EdgeTree::Cone& one, const EdgeTree::Cone& other)
{
  EdgeTree::Cone cone;
  cone.mostPerHeight = std::max(one.mostPerHeight, other.mostPerHeight);
  cone.reach = std::max(one.reach, other.reach);
  const glm::vec3 sum = one.axis + other.axis;
  const float length = glm::length(sum);
  if (!(one.cosine > 0.0f) || !(other.cosine > 0.0f) || !(length > 0.5f))
  {
    return cone;
  }
  cone.axis = sum / length;
  // Both axes are equally far from the middle. The angle added exceeds the error of cosines of
  // small angles.
  const EdgeTree::Cone& wider = one.cosine < other.cosine ? one : other;
  const float angle = std::acos(std::clamp(glm::dot(cone.axis, one.axis), -1.0f, 1.0f)) +
    std::atan2(wider.sine, wider.cosine) + 0.001f;
  cone.cosine = std::cos(angle);
  cone.sine = std::sin(angle);
  return cone;
}

} // namespace

void EdgeTree::update(const Occluders& occluders)
{
  if (this->versions_ == occluders.versions())
  {
    return;
  }
  this->versions_ = {}; // stays so if an error interrupts the update
  this->found_.update(occluders, updateCasterEdges);
  this->triangles_.clear();
  this->corners_.clear();
  this->bounds_.clear();
  this->opaqueBounds_.clear();
  this->edges_.clear();
  this->tree_ = {};
  std::vector<BvhRecord> records;
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    if (occluders.surfaces[i].casts && occluders.surfaces[i].triangleCount > 0)
    {
      this->addSurface(occluders, i, records);
    }
  }
  if (!records.empty())
  {
    this->tree_ = buildBvh(records, [this](const BvhRecord& of) { return this->bounds(of); });
  }
  this->cones_.assign(this->tree_.nodes.size(), {});
  if (!this->empty())
  {
    this->fit(0, this->conesOfTriangles(), levelsInParallel);
  }
  this->versions_ = occluders.versions();
}

void EdgeTree::addOpaque(const Bounds& bounds, std::vector<BvhRecord>& records)
{
  records.push_back({ static_cast<std::uint32_t>(this->opaqueBounds_.size()), 0, 0, true });
  this->opaqueBounds_.push_back(bounds);
}

void EdgeTree::addSurface(
  const Occluders& occluders, std::size_t surface, std::vector<BvhRecord>& records)
{
  const Surface& of = occluders.surfaces[surface];
  const auto position = [&](std::uint32_t vertex) { return occluders.positionsCentred[vertex]; };
  if (of.isInstanced())
  {
    for (const glm::mat4x3& instance : of.centredFromSource)
    {
      if (Surface::isLeftOut(instance))
      {
        continue;
      }
      Bounds bounds;
      for (std::uint32_t i = 0; i < of.vertexCount; ++i)
      {
        bounds.add(glm::dmat4x3(instance) * glm::dvec4(position(of.firstVertex + i), 1.0));
      }
      const double more = std::ldexp(bounds.radius() + glm::length(bounds.centre()), -16);
      this->addOpaque(inflated(bounds, more), records);
    }
    return;
  }
  const SurfaceEdges& found = this->found_.of(surface);
  const std::size_t firstRecord = records.size();
  const auto first = static_cast<std::uint32_t>(this->triangles_.size());
  const auto numberOf = [&](std::uint32_t triangle) { return first + triangle - of.firstTriangle; };
  this->triangles_.resize(first + of.triangleCount);
  this->corners_.resize(first + of.triangleCount);
  this->bounds_.resize(first + of.triangleCount);
  std::vector<std::uint8_t> isNeedle(of.triangleCount);
  tbb::parallel_for(std::uint32_t(0), of.triangleCount,
    [&](std::uint32_t i)
    {
      const glm::uvec3 vertices = occluders.triangles[of.firstTriangle + i];
      std::array<glm::vec3, 3>& corners = this->corners_[first + i];
      corners = { position(vertices.x), position(vertices.y), position(vertices.z) };
      EdgeTriangle& triangle = this->triangles_[first + i];
      triangle = edgeTriangle(corners, of.oneSided);
      Bounds& bounds = this->bounds_[first + i];
      for (const glm::vec3& corner : corners)
      {
        bounds.add(glm::dvec3(corner));
      }
      // A tracer may see a needle up to its own length beyond its box.
      isNeedle[i] = triangle.longest < mostSlender * triangle.height ? 0 : 1;
      const double more = isNeedle[i] != 0 ? triangle.longest : triangle.noise / triangle.height;
      bounds = inflated(bounds, more);
    });
  for (std::uint32_t i = 0; i < of.triangleCount; ++i)
  {
    if (of.cutout || isNeedle[i] != 0)
    {
      this->addOpaque(this->bounds_[first + i], records);
    }
    else
    {
      records.push_back({ first + i, 0, 0, false });
    }
  }
  if (of.cutout)
  {
    return;
  }
  // Each edge is stored with the first of its triangles, and edges of one triangle are consecutive.
  // Needles own no edges: the surface ends where they meet others.
  const auto trianglesOf = [&](const CasterEdge& edge)
  {
    std::array<std::uint32_t, 2> triangles{ { TreeEdge::none, TreeEdge::none } };
    std::size_t count = 0;
    for (const std::uint32_t triangle : edge.triangles)
    {
      if (triangle != CasterEdge::none && isNeedle[triangle - of.firstTriangle] == 0)
      {
        triangles[count++] = numberOf(triangle);
      }
    }
    return triangles;
  };
  std::vector<std::uint32_t> firstOf(of.triangleCount + 1, 0);
  std::vector<std::uint32_t> placeOf(found.edges.size());
  for (std::size_t i = 0; i < placeOf.size(); ++i)
  {
    const std::uint32_t owner = trianglesOf(found.edges[i])[0];
    placeOf[i] = owner != TreeEdge::none ? firstOf[owner - first + 1]++ : TreeEdge::none;
  }
  std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
  const std::size_t firstEdge = this->edges_.size();
  this->edges_.resize(firstEdge + firstOf.back());
  tbb::parallel_for(std::size_t(0), placeOf.size(),
    [&](std::size_t i)
    {
      if (placeOf[i] != TreeEdge::none)
      {
        const CasterEdge& edge = found.edges[i];
        const std::array<std::uint32_t, 2> triangles = trianglesOf(edge);
        this->edges_[firstEdge + firstOf[triangles[0] - first] + placeOf[i]] =
          this->treeEdge(triangles, position(edge.from), position(edge.to), edge.sameDirection);
      }
    });
  for (std::size_t i = firstRecord; i < records.size(); ++i)
  {
    BvhRecord& record = records[i];
    if (!record.opaque)
    {
      const std::uint32_t triangle = record.number - first;
      record.firstEdge = static_cast<std::uint32_t>(firstEdge) + firstOf[triangle];
      record.edgeCount = firstOf[triangle + 1] - firstOf[triangle];
    }
  }
}

/// Return the edge in the direction of its first triangle.
/// @param triangles numbers in the tree; the second may be `none`
TreeEdge EdgeTree::treeEdge(const std::array<std::uint32_t, 2>& triangles, const glm::vec3& from,
  const glm::vec3& to, bool sameDirection) const
{
  TreeEdge edge{ from, to, triangles, sameDirection, glm::length(to - from),
    this->triangles_[triangles[0]].longest };
  // Orient the edge along its first triangle.
  const std::array<glm::vec3, 3>& corners = this->corners_[triangles[0]];
  const bool runs = (corners[0] == from && corners[1] == to) ||
    (corners[1] == from && corners[2] == to) || (corners[2] == from && corners[0] == to);
  if (!runs)
  {
    std::swap(edge.from, edge.to);
  }
  if (triangles[1] != TreeEdge::none)
  {
    edge.reach = std::max(edge.reach, this->triangles_[triangles[1]].longest);
  }
  return edge;
}

/// Return for each triangle a cone around its own normal and those across its edges. An undefined
/// cone marks triangles with an edge that may have a weight from anywhere.
std::vector<EdgeTree::Cone> EdgeTree::conesOfTriangles() const
{
  std::vector<Cone> cones(this->triangles_.size());
  tbb::parallel_for(std::size_t(0), cones.size(),
    [&](std::size_t i)
    {
      const EdgeTriangle& triangle = this->triangles_[i];
      cones[i] = { glm::normalize(triangle.normal), 1.0f, 0.0f, 1.0f / triangle.height,
        triangle.longest };
    });
  const auto join = [&](std::uint32_t triangle, std::uint32_t across, float cosine)
  {
    Cone& cone = cones[triangle];
    const EdgeTriangle& other = this->triangles_[across];
    cone.cosine = std::min(cone.cosine, cosine);
    cone.mostPerHeight = std::max(cone.mostPerHeight, 1.0f / other.height);
    cone.reach = std::max(cone.reach, other.longest);
  };
  for (const TreeEdge& edge : this->edges_)
  {
    const auto [first, second] = edge.triangles;
    if (second == TreeEdge::none)
    {
      cones[first].cosine = -1.0f;
      continue;
    }
    const float cosine =
      edge.sameDirection ? -1.0f : glm::dot(cones[first].axis, cones[second].axis);
    join(first, second, cosine);
    join(second, first, cosine);
  }
  tbb::parallel_for(std::size_t(0), cones.size(),
    [&](std::size_t i)
    {
      // Subtract more than rounding adds.
      const double cosine = cones[i].cosine -= 2e-6f;
      cones[i].sine = static_cast<float>(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)));
    });
  return cones;
}

/// Fit the box and the cone of a node and of all below it to the records in their leaves.
/// @param parallel levels whose halves are still fitted in parallel
void EdgeTree::fit(std::uint32_t number, const std::vector<Cone>& ofTriangles, int parallel)
{
  BvhNode& node = this->tree_.nodes[number];
  const bool leaf = node.count > 0;
  const auto fitChild = [&](std::uint32_t child)
  { this->fit(node.first + child, ofTriangles, parallel - 1); };
  if (!leaf && parallel > 0)
  {
    tbb::parallel_invoke([&] { fitChild(0); }, [&] { fitChild(1); });
  }
  else if (!leaf)
  {
    fitChild(0);
    fitChild(1);
  }
  Bounds bounds;
  for (std::uint32_t i = node.first; i < node.first + (leaf ? node.count : 2); ++i)
  {
    Cone cone;
    if (leaf)
    {
      const BvhRecord& record = this->record(i);
      bounds.add(this->bounds(record));
      cone = record.opaque ? Cone{} : ofTriangles[record.number];
    }
    else
    {
      const BvhNode& child = this->tree_.nodes[i];
      bounds.add({ glm::dvec3(child.lower), glm::dvec3(child.upper) });
      cone = this->cones_[i];
    }
    this->cones_[number] = i == node.first ? cone : joined(this->cones_[number], cone);
  }
  // The node's floats must round outwards.
  const glm::dvec3 more =
    std::ldexp(1.0, -22) * glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
  node.lower = bounds.lower - more;
  node.upper = bounds.upper + more;
}

void EdgeTree::find(const Bounds& bounds, std::vector<std::uint32_t>& places) const
{
  places.clear();
  if (!this->empty())
  {
    this->find(bounds, 0, places);
  }
}

/// @param number of the subtree's node
void EdgeTree::find(
  const Bounds& bounds, std::uint32_t number, std::vector<std::uint32_t>& places) const
{
  const auto meets = [&](const auto& box)
  {
    return bounds.upper.x >= box.lower.x && bounds.lower.x <= box.upper.x &&
      bounds.upper.y >= box.lower.y && bounds.lower.y <= box.upper.y &&
      bounds.upper.z >= box.lower.z && bounds.lower.z <= box.upper.z;
  };
  const BvhNode& node = this->tree_.nodes[number];
  if (!meets(node))
  {
    return;
  }
  if (node.count == 0)
  {
    this->find(bounds, node.first, places);
    this->find(bounds, node.first + 1, places);
  }
  for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
  {
    if (meets(this->bounds(this->record(place))))
    {
      places.push_back(place);
    }
  }
}

std::size_t EdgeTree::bytes() const
{
  return bytesOf(this->triangles_) + bytesOf(this->corners_) + bytesOf(this->bounds_) +
    bytesOf(this->opaqueBounds_) + bytesOf(this->edges_) + bytesOf(this->tree_.nodes) +
    bytesOf(this->tree_.records) + bytesOf(this->cones_) + this->found_.bytes();
}

} // namespace gnomon
