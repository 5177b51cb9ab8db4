#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
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

/// Build a tree by Embree's builder. The caller computes the boxes from the contents of the leaves.
/// @param records the contents of the leaves, in any order; at least one
/// @param boundsOf returns the box of a record; called by several threads at once
/// @throws std::runtime_error if Embree cannot be started or fails, or for boxes beyond its range
Bvh buildBvh(
  const std::vector<BvhRecord>& records, const std::function<Bounds(const BvhRecord&)>& boundsOf);

} // namespace gnomon
