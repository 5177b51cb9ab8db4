#pragma once

#include "lights/Bounds.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <glm/glm.hpp>
#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon
{

/// A box with two children, or with the records of a leaf.
struct BvhNode
{
  glm::vec3 lower;
  std::uint32_t first; ///< of the records; without any, of two nodes
  glm::vec3 upper;
  std::uint32_t count; ///< of the records
};

/// The content of a leaf.
struct BvhRecord
{
  std::uint32_t number = 0;                   ///< of a triangle, or of a box with unknown edges
  std::uint32_t firstEdge = 0, edgeCount = 0; ///< edges owned by this triangle
  bool opaque = false;                        ///< true for such a box
};

/// A binary tree of boxes over records.
struct Bvh
{
  std::vector<BvhNode> nodes;     ///< the root first
  std::vector<BvhRecord> records; ///< leaf by leaf
};

inline constexpr std::uint32_t mostRecordsOfLeaf = 4;
/// The depth at which Embree's builder stops searching for the best cut and halves the rest. Forty
/// cuts leave less than a millionth of a scene.
inline constexpr unsigned int mostDepth = 48;

/// A tree as Embree builds it.
struct TreeNode
{
  std::array<TreeNode*, 2> children{};
  std::uint32_t count = 0; ///< records of a leaf; 0 in inner nodes
  std::array<std::uint32_t, mostRecordsOfLeaf> records{};
};

inline void* newTreeNode(RTCThreadLocalAllocator allocator)
{
  return new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), alignof(TreeNode))) TreeNode;
}

inline void* createLeaf(
  RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*)
{
  auto* leaf = static_cast<TreeNode*>(newTreeNode(allocator));
  leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    leaf->records[i] = primitives[i].primID;
  }
  return leaf;
}

inline void setChildren(void* node, void** children, unsigned int, void*)
{
  static_cast<TreeNode*>(node)->children = { static_cast<TreeNode*>(children[0]),
    static_cast<TreeNode*>(children[1]) };
}

/// Append a node's contents to a tree.
/// @param number of the node in the tree
/// @param records in Embree's order
inline void append(
  const TreeNode& from, std::size_t number, const std::vector<BvhRecord>& records, Bvh& tree)
{
  const std::size_t first = from.count > 0 ? tree.records.size() : tree.nodes.size();
  tree.nodes[number].first = static_cast<std::uint32_t>(first);
  tree.nodes[number].count = from.count;
  for (std::uint32_t i = 0; i < from.count; ++i)
  {
    tree.records.push_back(records[from.records[i]]);
  }
  tree.nodes.resize(tree.nodes.size() + (from.count > 0 ? 0 : 2));
  for (std::size_t child = 0; from.count == 0 && child < 2; ++child)
  {
    append(*from.children[child], first + child, records, tree);
  }
}

/// Build a tree by Embree's builder. The caller computes the boxes from the contents of the leaves.
/// @param records the contents of the leaves, in any order; at least one
/// @param boundsOf returns the box of a record; called by several threads at once
/// @throws std::runtime_error if Embree cannot be started or fails, or for boxes beyond its range
inline Bvh buildBvh(
  const std::vector<BvhRecord>& records, const std::function<Bounds(const BvhRecord&)>& boundsOf)
{
  const EmbreeDevice device = startEmbree();
  std::vector<RTCBuildPrimitive> primitives(records.size());
  tbb::parallel_for(std::size_t(0), records.size(),
    [&](std::size_t i)
    {
      const Bounds bounds = boundsOf(records[i]);
      checkEmbreeRange(bounds);
      const glm::vec3 lower(bounds.lower);
      const glm::vec3 upper(bounds.upper);
      primitives[i] = { lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z,
        static_cast<unsigned int>(i) };
    });
  const EmbreeBvh bvh(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxDepth = mostDepth;
  arguments.maxLeafSize = mostRecordsOfLeaf;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = [](RTCThreadLocalAllocator allocator, unsigned int, void*)
  { return newTreeNode(allocator); };
  arguments.setNodeChildren = setChildren;
  arguments.setNodeBounds = [](void*, const RTCBounds**, unsigned int, void*) {};
  arguments.createLeaf = createLeaf;
  const auto* root = static_cast<const TreeNode*>(rtcBuildBVH(&arguments));
  if (!root)
  {
    throw std::runtime_error("Embree failed while building a tree of the casters: error " +
      std::to_string(static_cast<int>(rtcGetDeviceError(device.get()))));
  }
  Bvh tree;
  tree.nodes.resize(1);
  append(*root, 0, records, tree);
  return tree;
}

} // namespace gnomon
