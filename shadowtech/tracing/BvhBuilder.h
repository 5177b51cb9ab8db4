#pragma once

#include "lights/Bounds.h"
#include "shadowtech/tracing/CasterBvh.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Builds binary trees by Embree's builder and appends them to nodes and records. The caller
/// computes the boxes from the contents of the leaves, of new trees as of refitted ones.
class BvhBuilder
{
public:
  /// @throws std::runtime_error if Embree cannot be started
  BvhBuilder(std::vector<BvhNode>& nodes, std::vector<BvhRecord>& records);

  struct Tree
  {
    std::uint32_t root; ///< link to the tree (BvhLink)
    int depth;          ///< number of inner nodes one below another
  };

  /// Append a tree.
  /// @param records the contents of the leaves, in any order; at least one
  /// @param boundsOf returns the box of a record; called by several threads at once
  /// @throws std::runtime_error if Embree fails
  Tree add(
    const std::vector<BvhRecord>& records, const std::function<Bounds(const BvhRecord&)>& boundsOf);

private:
  EmbreeDevice device_;
  std::vector<BvhNode>& nodes_;
  std::vector<BvhRecord>& records_;
};

} // namespace gnomon
