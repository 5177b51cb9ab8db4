#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/CasterEdges.h"
#include "shadowtech/mesh/KeptOfCasters.h"
#include "shadowtech/penumbra/Bvh.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The plane of a casting triangle, with bounds on rounding.
struct EdgeTriangle
{
  glm::dvec3 normal; ///< as long as the triangle's least height
  glm::vec3 corner;  ///< centred
  float height;      ///< the least of its three heights, in world units
  float longest;     ///< length of its longest side, in world units
  /// Bounds rounding of dot(v, normal) by dot(unsure, abs(v)).
  glm::vec3 unsure;
  /// How far off its plane, times its height, a tracer may see a point in its box.
  float noise;
  /// True if it blocks only rays through its back, which then faces away from the light.
  bool oneSided;

  /// Bounds rounding of a direction's product with twice the triangle's area vector. The factor
  /// applies to the direction's length times the squared reach of the corners
  /// (docs/theory/exact_penumbrae.md).
  static constexpr double noiseAlong = 128.0 / 16777216.0;

  /// Return true if rays certainly leave its plane, so that none meets it. Both signs must exceed
  /// rounding: the side where rays start, and their direction. An example is the surface that rays
  /// start on.
  /// @param behind the least and the most behind() of their starts
  /// @param reach bound, for each axis, of the distance from the starts to the corners
  /// @param along the least and the most of dot(direction, normal)
  /// @param longestDirection bound of the directions' length
  bool isLeft(const glm::dvec2& behind, const glm::dvec3& reach, const glm::dvec2& along,
    double longestDirection) const
  {
    const double unsureBehind = glm::dot(glm::dvec3(this->unsure), reach);
    const double unsureAlong =
      noiseAlong * glm::dot(reach, reach) / static_cast<double>(this->longest) * longestDirection;
    return (behind.y < -unsureBehind && along.x > unsureAlong) ||
      (behind.x > unsureBehind && along.y < -unsureAlong);
  }

  /// Return how far a point lies behind its plane, times its height. Behind is the side that sees
  /// its corners in clockwise order.
  double behind(const glm::dvec3& point) const
  {
    return glm::dot(glm::dvec3(this->corner) - point, this->normal);
  }
};

/// An edge of casters. If more than two triangles meet, each has its own edge.
struct TreeEdge
{
  glm::vec3 from, to; ///< centred
  /// Numbers in the tree. The first triangle runs along the edge; the second is `none` if the
  /// surface ends.
  std::array<std::uint32_t, 2> triangles;
  bool sameDirection; ///< true if the second runs along it, too
  float length;
  float reach; ///< bound of how far its triangles' corners are from the edge

  static constexpr std::uint32_t none = 0xffffffffu;
};

/// A bounding volume hierarchy of the edges and triangles of all casters. It finds the edges at
/// which casters seem to end from a point.
class EdgeTree
{
public:
  /// Update it to the snapshot.
  void update(const Occluders& occluders);

  const BvhRecord& record(std::uint32_t place) const { return this->tree_.records[place]; }

  /// A cone around the normals of all triangles in a node, and of those across their edges.
  struct Cone
  {
    glm::vec3 axis{ 0.0f };
    float cosine = -1.0f; ///< of its half angle; the cone is undefined if not above 0
    float sine = 0.0f;
    float mostPerHeight = 0.0f; ///< 1 over the least height of these triangles
    float reach = 0.0f;         ///< the largest reach of their edges
  };

  /// Find the places of records whose boxes meet another box.
  /// @param places receives them
  void find(const Bounds& bounds, std::vector<std::uint32_t>& places) const;

  /// Return true if rays from a start may begin on a record's triangle or box, allowing for
  /// rounding.
  bool isOn(const glm::vec3& start, const BvhRecord& record) const
  {
    const Bounds& box = this->bounds(record);
    const bool isIn = start.x >= box.lower.x && start.x <= box.upper.x && start.y >= box.lower.y &&
      start.y <= box.upper.y && start.z >= box.lower.z && start.z <= box.upper.z;
    return isIn &&
      (record.opaque ||
        !(std::abs(this->triangles_[record.number].behind(start)) >
          this->triangles_[record.number].noise));
  }

  bool empty() const { return this->tree_.records.empty(); }
  std::size_t size() const { return this->tree_.records.size(); }
  /// Return a node. Its box also holds all starts that are too close to its content for a certain
  /// side.
  const BvhNode& node(std::uint32_t number) const { return this->tree_.nodes[number]; }
  const Cone& cone(std::uint32_t node) const { return this->cones_[node]; }
  const TreeEdge& edge(std::uint32_t number) const { return this->edges_[number]; }
  const EdgeTriangle& triangle(std::uint32_t number) const { return this->triangles_[number]; }
  const std::array<glm::vec3, 3>& corners(std::uint32_t triangle) const
  {
    return this->corners_[triangle];
  }
  /// Return the largest distance from a point to a triangle's corners, for each axis.
  glm::dvec3 reach(std::uint32_t triangle, const glm::dvec3& point) const
  {
    glm::dvec3 reach(0.0);
    for (const glm::vec3& corner : this->corners_[triangle])
    {
      reach = glm::max(reach, glm::abs(glm::dvec3(corner) - point));
    }
    return reach;
  }
  const Bounds& bounds(const BvhRecord& record) const
  {
    return (record.opaque ? this->opaqueBounds_ : this->bounds_)[record.number];
  }

  std::size_t bytes() const;

private:
  void addSurface(const Occluders& occluders, std::size_t surface, std::vector<BvhRecord>& records);
  void addOpaque(const Bounds& bounds, std::vector<BvhRecord>& records);
  TreeEdge treeEdge(const std::array<std::uint32_t, 2>& triangles, const glm::vec3& from,
    const glm::vec3& to, bool sameDirection) const;
  void fit(std::uint32_t number, const std::vector<Cone>& ofTriangles, int parallel);
  void find(const Bounds& bounds, std::uint32_t number, std::vector<std::uint32_t>& places) const;
  std::vector<Cone> conesOfTriangles() const;

  KeptOfCasters<SurfaceEdges> found_;
  std::vector<EdgeTriangle> triangles_;
  std::vector<std::array<glm::vec3, 3>> corners_;
  std::vector<Bounds> bounds_; ///< of the triangles, grown by their noise
  std::vector<Bounds> opaqueBounds_;
  std::vector<TreeEdge> edges_;
  Bvh tree_;
  std::vector<Cone> cones_; ///< one for each node
  Occluders::Versions versions_;
};

} // namespace gnomon
