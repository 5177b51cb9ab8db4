#include "shadowtech/tracing/CasterBvh.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gnomon
{
namespace
{

/// Where Embree's builder gives up looking for the best cut. Forty cuts leave less than a millionth of a
/// scene; it halves what is left.
constexpr unsigned int mostDepth = 48;

/// How much worse than when it was built a tree may become before another one is built.
constexpr double mostCostRatio = 2.0;

/// A tree as Embree builds it. Boxes are left out: fitBoxes() finds them, for new trees as for old ones.
struct TreeNode
{
  std::array<TreeNode*, 2> children{};
  std::uint32_t count = 0; ///< of a leaf
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

  /// @return the link to what was appended
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

  /// Inner nodes one below another.
  int depth() const { return this->depth_; }

private:
  std::vector<BvhNode>& nodes_;
  std::vector<BvhRecord>& records_;
  const std::vector<BvhRecord>& unordered_;
  int depth_ = 0;
};

/// Builds trees and appends them.
class TreeBuilder
{
public:
  TreeBuilder(std::vector<BvhNode>& nodes, std::vector<BvhRecord>& records)
    : device_(rtcNewDevice(nullptr))
    , nodes_(nodes)
    , records_(records)
  {
    if (!this->device_.get())
    {
      throw std::runtime_error("Embree cannot be started on this machine");
    }
  }

  struct Tree
  {
    std::uint32_t root;
    int depth;
  };

  /// @param boundsOf box of a record
  template <typename BoundsOf>
  Tree add(const std::vector<BvhRecord>& records, const BoundsOf& boundsOf)
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
      throw std::runtime_error(
        "Embree failed while building the tree of the GPU's ray tracer: error " +
        std::to_string(static_cast<int>(rtcGetDeviceError(this->device_.get()))));
    }
    Flattening flattening(this->nodes_, this->records_, records);
    const std::uint32_t link = flattening.append(root);
    return { link, flattening.depth() };
  }

private:
  EmbreeDevice device_;
  std::vector<BvhNode>& nodes_;
  std::vector<BvhRecord>& records_;
};

bool isCaster(const Surface& surface)
{
  return surface.casts && surface.triangleCount > 0;
}

void addTriangles(const Occluders& occluders, const Surface& surface, std::uint32_t flags,
  std::vector<BvhRecord>& records)
{
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    records.emplace_back(occluders.triangles[surface.firstTriangle + i], flags);
  }
}

Bounds verticesBounds(const Occluders& occluders, const Surface& surface)
{
  Bounds bounds;
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    bounds.add(glm::dvec3(occluders.positionsCentred[surface.firstVertex + i]));
  }
  return bounds;
}

/// The box around the image of a box. It is larger by what taking a ray into source coordinates may be off
/// by: ShadowRay.h's bound for an instance's rows is 8u (|r_i|.|O| + |r_i|.|T|) each, times the column
/// |c_i|, with |c_i||r_i| <= 2 for the skewness that instances may have; summed over three axes less than
/// 2^-17 (|O| + |T|). The share of the ray's origin is bvh.glsl's.
Bounds imageBounds(const glm::mat4x3& centredFromSource, const Bounds& source)
{
  const glm::dmat4x3 matrix(centredFromSource);
  const glm::dvec3 half = 0.5 * (source.upper - source.lower);
  const glm::dvec3 centre = matrix * glm::dvec4(source.centre(), 1.0);
  const glm::dvec3 off = glm::abs(matrix[3]);
  const glm::dvec3 reach = glm::abs(matrix[0]) * half.x + glm::abs(matrix[1]) * half.y +
    glm::abs(matrix[2]) * half.z + std::ldexp(std::max({ off.x, off.y, off.z }), -17);
  return { centre - reach, centre + reach };
}

double halfArea(const glm::vec3& lower, const glm::vec3& upper)
{
  const glm::dvec3 size = glm::dvec3(upper) - glm::dvec3(lower);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

} // namespace

//------------------------------------------------------------------------------
CasterBvh::Change CasterBvh::update(const Occluders& occluders)
{
  if (this->topologyVersion_ == occluders.topologyVersion &&
    this->positionsVersion_ == occluders.positionsVersion)
  {
    return Change::None;
  }
  bool build = this->topologyVersion_ != occluders.topologyVersion;
  if (!build)
  {
    this->placeInstances(occluders);
    this->fitBoxes(occluders);
    build = this->cost() > mostCostRatio * this->builtCost_;
  }
  if (build)
  {
    try
    {
      this->build(occluders);
    }
    catch (...)
    {
      *this = CasterBvh(); // rather nothing than half of it
      throw;
    }
  }
  this->topologyVersion_ = occluders.topologyVersion;
  this->positionsVersion_ = occluders.positionsVersion;
  return build ? Change::Built : Change::Refitted;
}

//------------------------------------------------------------------------------
void CasterBvh::build(const Occluders& occluders)
{
  *this = CasterBvh();
  TreeBuilder builder(this->nodes_, this->records_);
  const auto boundsOf = [&](const BvhRecord& record)
  { return this->recordBounds(record, occluders); };
  std::vector<BvhRecord> all;
  int deepestBelow = 0;
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    const Surface& surface = occluders.surfaces[i];
    if (!isCaster(surface))
    {
      continue;
    }
    const std::uint32_t flags = (surface.oneSided ? BvhFlag::oneSided : 0) |
      (surface.mirrored ? BvhFlag::mirrored : 0) |
      (surface.cutout ? BvhFlag::cutout | static_cast<std::uint32_t>(this->cutoutSurfaces_.size())
                      : 0);
    if (surface.cutout)
    {
      this->cutoutSurfaces_.push_back(i);
    }
    if (!surface.isInstanced())
    {
      addTriangles(occluders, surface, flags, all);
      continue;
    }
    std::vector<BvhRecord> own;
    addTriangles(occluders, surface, flags, own);
    const TreeBuilder::Tree tree = builder.add(own, boundsOf);
    deepestBelow = std::max(deepestBelow, tree.depth);
    for (const glm::mat4x3& instance : surface.centredFromSource)
    {
      if (!Surface::isLeftOut(instance))
      {
        all.emplace_back(this->instances_.size(), 0, 0, BvhFlag::instance);
        this->instances_.push_back({ {}, {}, tree.root, {} });
      }
    }
  }
  if (all.size() + this->records_.size() > BvhLink::firstMask)
  {
    throw std::runtime_error("the GPU's ray tracer takes up to " +
      std::to_string(BvhLink::firstMask) + " casting triangles, and there are more");
  }
  if (all.empty())
  {
    this->records_.clear(); // all instances of whatever there is are left out
    this->nodes_.clear();
    return;
  }
  this->placeInstances(occluders);
  this->firstNodeOfAll_ = this->nodes_.size();
  const TreeBuilder::Tree tree = builder.add(all, boundsOf);
  this->root_ = tree.root;
  // Below the first link, which ends the walk, one waits at each node passed. Instances of a leaf wait
  // together; below the one that is entered lies the link that leaves it.
  this->stackSize_ = 1 + tree.depth;
  if (!this->instances_.empty())
  {
    this->stackSize_ += static_cast<int>(BvhLink::mostRecordsOfLeaf) + 1 + deepestBelow;
  }
  this->fitBoxes(occluders);
  this->builtCost_ = this->cost();
}

//------------------------------------------------------------------------------
/// Takes over the matrices of the instances that are not left out, in their order.
void CasterBvh::placeInstances(const Occluders& occluders)
{
  this->instanceBounds_.clear();
  auto instance = this->instances_.begin();
  for (const Surface& surface : occluders.surfaces)
  {
    if (!isCaster(surface) || !surface.isInstanced())
    {
      continue;
    }
    const Bounds source = verticesBounds(occluders, surface);
    for (const glm::mat4x3& matrix : surface.centredFromSource)
    {
      if (Surface::isLeftOut(matrix))
      {
        continue;
      }
      const glm::dmat4x3 placed(matrix);
      const glm::dmat3 inverse =
        glm::inverse(glm::dmat3(placed)); // regular, as the snapshot promises
      const glm::dvec3 origin = -(inverse * placed[3]);
      for (int row = 0; row < 3; ++row)
      {
        instance->sourceFromCentred[static_cast<std::size_t>(row)] =
          glm::dvec4(inverse[0][row], inverse[1][row], inverse[2][row], origin[row]);
      }
      instance->lowerSource = source.lower;
      instance->upperSource = source.upper;
      ++instance;
      this->instanceBounds_.push_back(imageBounds(matrix, source));
    }
  }
}

//------------------------------------------------------------------------------
/// Finds the boxes of all nodes from what lies in the leaves.
void CasterBvh::fitBoxes(const Occluders& occluders)
{
  const auto setBox = [](BvhNode& node, const Bounds& bounds)
  {
    node.lower = bounds.lower;
    node.upper = bounds.upper;
  };
  constexpr std::size_t grain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, this->nodes_.size(), grain),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        if (BvhLink::isLeaf(this->nodes_[i].link))
        {
          setBox(this->nodes_[i], this->linkBounds(this->nodes_[i].link, occluders));
        }
      }
    });
  for (auto node = this->nodes_.rbegin(); node != this->nodes_.rend(); ++node)
  {
    if (!BvhLink::isLeaf(node->link))
    {
      setBox(*node, this->linkBounds(node->link, occluders));
    }
  }
  this->bounds_ = this->linkBounds(this->root_, occluders);
}

//------------------------------------------------------------------------------
Bounds CasterBvh::recordBounds(const BvhRecord& record, const Occluders& occluders) const
{
  if (record.w & BvhFlag::instance)
  {
    return this->instanceBounds_[record.x];
  }
  Bounds bounds;
  for (int corner = 0; corner < 3; ++corner)
  {
    bounds.add(glm::dvec3(occluders.positionsCentred[record[corner]]));
  }
  return bounds;
}

//------------------------------------------------------------------------------
/// The box around what a link leads to; of a leaf its records', else its two nodes'.
Bounds CasterBvh::linkBounds(std::uint32_t link, const Occluders& occluders) const
{
  Bounds bounds;
  if (BvhLink::isLeaf(link))
  {
    for (std::uint32_t i = 0; i < BvhLink::count(link); ++i)
    {
      bounds.add(this->recordBounds(this->records_[BvhLink::first(link) + i], occluders));
    }
    return bounds;
  }
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    bounds.add(
      { glm::dvec3(this->nodes_[link + i].lower), glm::dvec3(this->nodes_[link + i].upper) });
  }
  return bounds;
}

//------------------------------------------------------------------------------
/// How many boxes of the upper level a ray through the whole meets on average (surface area heuristic). 0
/// where there are none, or all lie in a line.
double CasterBvh::cost() const
{
  double sum = 0.0;
  for (std::size_t i = this->firstNodeOfAll_; i < this->nodes_.size(); ++i)
  {
    sum += halfArea(this->nodes_[i].lower, this->nodes_[i].upper);
  }
  const double all = halfArea(this->bounds_.lower, this->bounds_.upper);
  return all > 0.0 ? sum / all : 0.0;
}

//------------------------------------------------------------------------------
std::size_t CasterBvh::bytes() const
{
  return bytesOf(this->nodes_) + bytesOf(this->records_) + bytesOf(this->instances_) +
    bytesOf(this->instanceBounds_) + bytesOf(this->cutoutSurfaces_);
}

} // namespace gnomon
