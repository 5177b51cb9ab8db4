#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/CasterEdges.h"
#include "shadowtech/mesh/KeptOfCasters.h"
#include "shadowtech/tracing/CasterBvh.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The plane of a casting triangle, and what rounding makes of it.
struct EdgeTriangle
{
  glm::dvec3 normal; ///< as long as the triangle's least height
  glm::vec3 corner;  ///< centred
  float height;      ///< the least of its three, in world units
  float longest;     ///< of its sides
  /// What rounding makes of a product with the normal: up to dot(unsure, abs(v)) of dot(v, normal).
  glm::vec3 unsure;
  /// How far off its plane, times its height, a point in its box may seem to lie.
  float noise;
  bool oneSided; ///< blocks rays through its back alone, which then faces away from the light

  /// What rounding makes of a direction's product with twice the triangle's area vector: so much of
  /// the direction's length times the squared reach of its corners
  /// (docs/theory/exact_penumbrae.md).
  static constexpr double noiseAlong = 128.0 / 16777216.0;

  /// Whether rays that start on one side of its plane go away from it for certain, so that none
  /// meets it, whatever rounding makes of these two signs: as those from the surface that they
  /// start on.
  /// @param behind the least and the most of their starts'
  /// @param reach of the corners from the starts, at most, axis by axis
  /// @param along the least and the most of dot(direction, normal)
  /// @param longestDirection not less than their length
  bool isLeft(const glm::dvec2& behind, const glm::dvec3& reach, const glm::dvec2& along,
    double longestDirection) const
  {
    const double unsureBehind = glm::dot(glm::dvec3(this->unsure), reach);
    const double unsureAlong =
      noiseAlong * glm::dot(reach, reach) / static_cast<double>(this->longest) * longestDirection;
    return (behind.y < -unsureBehind && along.x > unsureAlong) ||
      (behind.x > unsureBehind && along.y < -unsureAlong);
  }

  /// How far a point lies behind its plane, times its height. Behind is where its corners run
  /// clockwise.
  double behind(const glm::dvec3& point) const
  {
    return glm::dot(glm::dvec3(this->corner) - point, this->normal);
  }
};

/// An edge of casters. Where more than two triangles meet, each has one of its own.
struct TreeEdge
{
  glm::vec3 from, to; ///< centred
  /// Of the tree; the first runs along the edge. The second is `none` where the surface ends.
  std::array<std::uint32_t, 2> triangles;
  bool sameDirection; ///< whether the second runs along it, too
  float length;
  float reach; ///< how far from the edge its triangles' corners may be

  static constexpr std::uint32_t none = 0xffffffffu;
};

/// The edges and triangles of all casters in a bounding volume hierarchy, from which whoever stands
/// somewhere may ask for the edges at which casters seem to end.
class EdgeTree
{
public:
  /// Brings it up to date with the snapshot.
  /// @throws std::runtime_error if Embree fails
  void update(const Occluders& occluders);

  /// What leaves hold.
  struct Record
  {
    std::uint32_t number;               ///< of a triangle, or of a box of which no edges are known
    std::uint32_t firstEdge, edgeCount; ///< that count for this triangle, and for no other
    bool opaque;                        ///< whether it is such a box
  };
  Record record(std::uint32_t place) const
  {
    const BvhRecord& of = this->records_[place];
    return { of.x, of.y, of.z, of.w != 0 };
  }

  /// Where all triangles of a part of the tree, and those across their edges, face.
  struct Cone
  {
    glm::vec3 axis{ 0.0f };
    float cosine = -1.0f; ///< of its half angle; not above 0 where it says nothing
    float sine = 0.0f;
    float mostPerHeight = 0.0f; ///< 1 over the least height of these triangles
    float reach = 0.0f;         ///< the most of their edges'
  };

  /// Finds the places of records whose boxes meet another box.
  /// @param places gets them
  void find(const Bounds& bounds, std::vector<std::uint32_t>& places) const;

  /// Whether rays from a start may begin on what a record stands for, as far as rounding says.
  bool isOn(const glm::vec3& start, const Record& record) const
  {
    const Bounds& box = this->bounds(record);
    const bool isIn = start.x >= box.lower.x && start.x <= box.upper.x && start.y >= box.lower.y &&
      start.y <= box.upper.y && start.z >= box.lower.z && start.z <= box.upper.z;
    return isIn &&
      (record.opaque ||
        !(std::abs(this->triangles_[record.number].behind(start)) >
          this->triangles_[record.number].noise));
  }

  bool empty() const { return this->records_.empty(); }
  /// How many records there are.
  std::size_t size() const { return this->records_.size(); }
  std::uint32_t root() const { return this->root_; }
  /// Its box is that of what it holds, and of where shadow rays may start too close to that to say
  /// on which side.
  const BvhNode& node(std::uint32_t number) const { return this->nodes_[number]; }
  const Cone& cone(std::uint32_t node) const { return this->cones_[node]; }
  const TreeEdge& edge(std::uint32_t number) const { return this->edges_[number]; }
  const EdgeTriangle& triangle(std::uint32_t number) const { return this->triangles_[number]; }
  const std::array<glm::vec3, 3>& corners(std::uint32_t triangle) const
  {
    return this->corners_[triangle];
  }
  /// How far from a point a triangle's corners are, axis by axis.
  glm::dvec3 reach(std::uint32_t triangle, const glm::dvec3& point) const
  {
    glm::dvec3 reach(0.0);
    for (const glm::vec3& corner : this->corners_[triangle])
    {
      reach = glm::max(reach, glm::abs(glm::dvec3(corner) - point));
    }
    return reach;
  }
  /// Of a record.
  const Bounds& bounds(const Record& record) const
  {
    return (record.opaque ? this->opaqueBounds_ : this->bounds_)[record.number];
  }

  std::size_t bytes() const;

private:
  void addSurface(const Occluders& occluders, std::size_t surface, std::vector<BvhRecord>& records);
  void addOpaque(const Bounds& bounds, std::vector<BvhRecord>& records);
  TreeEdge treeEdge(const std::array<std::uint32_t, 2>& triangles, const glm::vec3& from,
    const glm::vec3& to, bool sameDirection) const;
  void fitNodes(std::uint32_t link, const std::vector<Cone>& ofTriangles, int parallel);
  void fitNode(std::uint32_t number, const std::vector<Cone>& ofTriangles);
  void find(const Bounds& bounds, std::uint32_t link, std::vector<std::uint32_t>& places) const;
  std::vector<Cone> conesOfTriangles() const;

  KeptOfCasters<SurfaceEdges> found_;
  std::vector<EdgeTriangle> triangles_;
  std::vector<std::array<glm::vec3, 3>> corners_;
  std::vector<Bounds> bounds_; ///< of the triangles, with their noise
  std::vector<Bounds> opaqueBounds_;
  std::vector<TreeEdge> edges_;
  std::vector<BvhNode> nodes_;
  std::vector<BvhRecord> records_;
  std::vector<Cone> cones_; ///< of the nodes
  std::uint32_t root_ = 0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon
