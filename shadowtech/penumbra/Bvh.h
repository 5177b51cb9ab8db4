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

/// A box and a link to its contents. The two children of a node lie side by side; the first one has
/// the even number.
struct BvhNode
{
  glm::vec3 lower;
  std::uint32_t link; ///< to its contents (BvhLink)
  glm::vec3 upper;
};

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

/// A leaf's record, whose numbers the tree's owner chooses.
using BvhRecord = glm::uvec4;

/// A binary tree of boxes over records.
struct Bvh
{
  std::vector<BvhNode> nodes;
  std::vector<BvhRecord> records; ///< leaf by leaf
  std::uint32_t root = 0;         ///< link to the tree (BvhLink)
};

/// The depth at which Embree's builder stops searching for the best cut and halves the rest. Forty
/// cuts leave less than a millionth of a scene.
inline constexpr unsigned int mostDepth = 48;

/// A tree as Embree builds it.
struct TreeNode
{
  std::array<TreeNode*, 2> children{};
  std::uint32_t count = 0; ///< records of a leaf; 0 in inner nodes
  std::array<std::uint32_t, BvhLink::mostRecordsOfLeaf> records{};
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
/// @param records in Embree's order
/// @return the link to them
inline std::uint32_t append(const TreeNode& node, const std::vector<BvhRecord>& records, Bvh& tree)
{
  if (node.count > 0)
  {
    const auto first = static_cast<std::uint32_t>(tree.records.size());
    for (std::uint32_t i = 0; i < node.count; ++i)
    {
      tree.records.push_back(records[node.records[i]]);
    }
    return BvhLink::leaf(first, node.count);
  }
  const std::size_t pair = tree.nodes.size();
  tree.nodes.resize(pair + 2);
  for (std::size_t child = 0; child < 2; ++child)
  {
    const std::uint32_t link = append(*node.children[child], records, tree);
    tree.nodes[pair + child].link = link;
  }
  return static_cast<std::uint32_t>(pair);
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
  arguments.maxLeafSize = BvhLink::mostRecordsOfLeaf;
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
  tree.root = append(*root, records, tree);
  return tree;
}

} // namespace gnomon
