#include "shadowtech/tracing/BvhBuilder.h"

#include "shadowtech/tracing/Embree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace gnomon
{
namespace
{

/// The depth at which Embree's builder stops searching for the best cut and halves the rest. Forty
/// cuts leave less than a millionth of a scene.
constexpr unsigned int mostDepth = 48;

/// A tree as Embree builds it.
struct TreeNode
{
  std::array<TreeNode*, 2> children{};
  std::uint32_t count = 0; ///< records of a leaf; 0 in inner nodes
  std::array<std::uint32_t, BvhLink::mostRecordsOfLeaf> records{};
};

void* newTreeNode(RTCThreadLocalAllocator allocator)
{
  return new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), alignof(TreeNode))) TreeNode;
}

void* createLeaf(
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

void setChildren(void* node, void** children, unsigned int, void*)
{
  static_cast<TreeNode*>(node)->children = { static_cast<TreeNode*>(children[0]),
    static_cast<TreeNode*>(children[1]) };
}

/// Appends a tree's nodes and its leaves' records to those of all trees.
class Flattening
{
public:
  Flattening(std::vector<BvhNode>& nodes, std::vector<BvhRecord>& records,
    const std::vector<BvhRecord>& unordered)
    : nodes_(nodes)
    , records_(records)
    , unordered_(unordered)
  {
  }

  /// @return the link to the appended nodes
  std::uint32_t append(const TreeNode* node, int depth = 0)
  {
    this->depth_ = std::max(this->depth_, depth);
    if (node->count > 0)
    {
      const auto first = static_cast<std::uint32_t>(this->records_.size());
      for (std::uint32_t i = 0; i < node->count; ++i)
      {
        this->records_.push_back(this->unordered_[node->records[i]]);
      }
      return BvhLink::leaf(first, node->count);
    }
    const std::size_t pair = this->nodes_.size();
    this->nodes_.resize(pair + 2);
    for (std::size_t child = 0; child < 2; ++child)
    {
      const std::uint32_t link = this->append(node->children[child], depth + 1);
      this->nodes_[pair + child].link = link;
    }
    return static_cast<std::uint32_t>(pair);
  }

  /// Return the number of inner nodes one below another.
  int depth() const { return this->depth_; }

private:
  std::vector<BvhNode>& nodes_;
  std::vector<BvhRecord>& records_;
  const std::vector<BvhRecord>& unordered_;
  int depth_ = 0;
};

} // namespace

//------------------------------------------------------------------------------
BvhBuilder::BvhBuilder(std::vector<BvhNode>& nodes, std::vector<BvhRecord>& records)
  : device_(rtcNewDevice(nullptr))
  , nodes_(nodes)
  , records_(records)
{
  if (!this->device_.get())
  {
    throw std::runtime_error("Embree cannot be started on this machine");
  }
}

//------------------------------------------------------------------------------
BvhBuilder::Tree BvhBuilder::add(
  const std::vector<BvhRecord>& records, const std::function<Bounds(const BvhRecord&)>& boundsOf)
{
  std::vector<RTCBuildPrimitive> primitives(records.size());
  tbb::parallel_for(std::size_t(0), records.size(),
    [&](std::size_t i)
    {
      const Bounds bounds = boundsOf(records[i]);
      const glm::vec3 lower(bounds.lower);
      const glm::vec3 upper(bounds.upper);
      primitives[i] = { lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z,
        static_cast<unsigned int>(i) };
    });
  const EmbreeBvh bvh(rtcNewBVH(this->device_.get()));
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
      std::to_string(static_cast<int>(rtcGetDeviceError(this->device_.get()))));
  }
  Flattening flattening(this->nodes_, this->records_, records);
  const std::uint32_t link = flattening.append(root);
  return { link, flattening.depth() };
}

} // namespace gnomon
