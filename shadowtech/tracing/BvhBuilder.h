#pragma once

#include "lights/Bounds.h"
#include "shadowtech/tracing/CasterBvh.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

/// Builds binary trees by Embree's builder and appends them to nodes and records. Boxes are left
/// out: whoever asked for a tree finds them from what lies in its leaves, of new trees as of old
/// ones.
class BvhBuilder
{
public:
  /// @throws std::runtime_error where Embree cannot be started
  BvhBuilder(std::vector<BvhNode>& nodes, std::vector<BvhRecord>& records);

  struct Tree
  {
    std::uint32_t root; ///< link to it (BvhLink)
    int depth;          ///< inner nodes one below another
  };

  /// @param records what the leaves of the new tree hold, in any order; at least one
  /// @param boundsOf box of a record; called by several threads at once
  /// @throws std::runtime_error if Embree fails
  Tree add(
    const std::vector<BvhRecord>& records, const std::function<Bounds(const BvhRecord&)>& boundsOf);

private:
  EmbreeDevice device_;
  std::vector<BvhNode>& nodes_;
  std::vector<BvhRecord>& records_;
};

} // namespace gnomon
