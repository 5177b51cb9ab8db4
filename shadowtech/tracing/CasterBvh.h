#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// @file
/// The bounding volume hierarchy of the casting surfaces, in the layout that the GPU traverses
/// (bvh.glsl).
///
/// It is one binary tree over all casting triangles of all surfaces. Each instance of a surface is
/// one more leaf record, which leads to the surface's own tree in source coordinates: two levels,
/// as in Embree.

/// A box and a link to its contents. The two children of a node lie side by side; the first one has
/// the even number.
struct BvhNode
{
  glm::vec3 lower;
  std::uint32_t link; ///< to its contents (BvhLink)
  glm::vec3 upper;
  std::uint32_t unused = 0; ///< the GPU reads a vec3 as 16 bytes
};

static_assert(sizeof(BvhNode) == 32, "as bvh.glsl reads it");

/// A link to a node's contents: the number of the first of two nodes, or a leaf, whose `count`
/// records begin at `first`.
namespace BvhLink
{
constexpr std::uint32_t leafBit = 0x80000000u;
constexpr unsigned int countShift = 28; ///< of the number of records less 1, two bits
constexpr std::uint32_t firstMask = 0x0fffffffu;
constexpr std::uint32_t mostRecordsOfLeaf = 4;

constexpr bool isLeaf(std::uint32_t link)
{
  return (link & leafBit) != 0;
}
constexpr std::uint32_t leaf(std::uint32_t first, std::uint32_t count)
{
  return leafBit | (count - 1) << countShift | first;
}
constexpr std::uint32_t first(std::uint32_t link)
{
  return link & firstMask;
}
constexpr std::uint32_t count(std::uint32_t link)
{
  return ((link >> countShift) & 3u) + 1;
}
} // namespace BvhLink

/// A leaf's record: three vertices of a triangle (indices into the snapshot's positions) and its
/// flags. For an instance: its number, 0, 0 and the flag `instance`.
using BvhRecord = glm::uvec4;
namespace BvhFlag
{
constexpr std::uint32_t instance = 0x80000000u;
constexpr std::uint32_t oneSided = 0x40000000u;   ///< counts only if the front faces the light
constexpr std::uint32_t mirrored = 0x20000000u;   ///< source coordinates show the other side
constexpr std::uint32_t cutout = 0x10000000u;     ///< its surface has holes
constexpr std::uint32_t numberMask = 0x0fffffffu; ///< number of its surface among those with holes
} // namespace BvhFlag

/// An instance and the tree of its surface.
struct BvhInstance
{
  std::array<glm::vec4, 3> sourceFromCentred; ///< rows
  glm::vec3 lowerSource;                      ///< box of the surface
  std::uint32_t root;                         ///< link to its tree
  glm::vec3 upperSource;
  std::uint32_t unused = 0;
};

static_assert(sizeof(BvhInstance) == 80, "as trace_rays.comp.glsl reads it");

class CasterBvh
{
public:
  /// The effect of an update.
  enum class Change
  {
    None,
    Refitted, ///< only boxes and instances changed
    Built
  };

  /// Update the tree for the snapshot. Moved vertices and instances refit its boxes, unless the
  /// boxes overlap so much that a new tree is better.
  /// @throws std::runtime_error if there are more casters than a link can hold, or Embree fails
  Change update(const Occluders& occluders);

  bool empty() const { return this->records_.empty(); }
  const std::vector<BvhNode>& nodes() const { return this->nodes_; }
  const std::vector<BvhRecord>& records() const { return this->records_; }
  const std::vector<BvhInstance>& instances() const { return this->instances_; }
  std::uint32_t root() const { return this->root_; }
  /// Return the box around all casters, centred.
  const Bounds& bounds() const { return this->bounds_; }
  /// Return the casting surfaces with holes, as indices into the snapshot, by the numbers that
  /// records give them.
  const std::vector<std::size_t>& cutoutSurfaces() const { return this->cutoutSurfaces_; }
  /// Return the largest number of links that traversal keeps on its stack, on both levels together.
  int stackSize() const { return this->stackSize_; }

  std::size_t bytes() const;

private:
  void build(const Occluders& occluders);
  void placeInstances(const Occluders& occluders);
  void fitBoxes(const Occluders& occluders);
  Bounds recordBounds(const BvhRecord& record, const Occluders& occluders) const;
  Bounds linkBounds(std::uint32_t link, const Occluders& occluders) const;
  double cost() const;

  std::vector<BvhNode> nodes_; ///< every node comes before its children
  std::vector<BvhRecord> records_;
  std::vector<BvhInstance> instances_;
  std::vector<Bounds> instanceBounds_; ///< centred, of instances_
  std::vector<std::size_t> cutoutSurfaces_;
  std::uint32_t root_ = 0;
  std::size_t firstNodeOfAll_ = 0; ///< after those of the trees in source coordinates
  Bounds bounds_;
  int stackSize_ = 0;
  double builtCost_ = 0.0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon
