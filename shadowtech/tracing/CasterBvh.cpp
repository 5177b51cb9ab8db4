#include "shadowtech/tracing/CasterBvh.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/tracing/BvhBuilder.h"

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

/// A tree is rebuilt when its cost exceeds this many times its cost after the build.
constexpr double mostCostRatio = 2.0;

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

/// Return the box around the image of a box, grown by the error of transforming a ray to source
/// coordinates. ShadowRay.h bounds each of an instance's rows by 8u (|r_i|.|O| + |r_i|.|T|). This
/// is multiplied by the column |c_i|, with |c_i||r_i| <= 2 for the skewness that instances may
/// have. The sum over three axes is less than 2^-17 (|O| + |T|). bvh.glsl adds the share of the
/// ray's origin.
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
      *this = CasterBvh(); // no tree is better than half a tree
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
  BvhBuilder builder(this->nodes_, this->records_);
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
    const BvhBuilder::Tree tree = builder.add(own, boundsOf);
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
    throw std::runtime_error("the GPU's ray tracer supports up to " +
      std::to_string(BvhLink::firstMask) + " casting triangles, but there are more");
  }
  if (all.empty())
  {
    this->records_.clear(); // all instances are left out
    this->nodes_.clear();
    return;
  }
  this->placeInstances(occluders);
  this->firstNodeOfAll_ = this->nodes_.size();
  const BvhBuilder::Tree tree = builder.add(all, boundsOf);
  this->root_ = tree.root;
  // The first entry ends the traversal. Above it, one link waits per node passed. Instances of a
  // leaf wait together. Entering one pushes the link that leaves it, then links of its tree.
  this->stackSize_ = 1 + tree.depth;
  if (!this->instances_.empty())
  {
    this->stackSize_ += static_cast<int>(BvhLink::mostRecordsOfLeaf) + 1 + deepestBelow;
  }
  this->fitBoxes(occluders);
  this->builtCost_ = this->cost();
}

//------------------------------------------------------------------------------
/// Copy the matrices of the instances that are not left out, in their order.
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
/// Compute the boxes of all nodes from the contents of the leaves.
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
/// Return the box around a link's contents: a leaf's records, else two nodes.
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
/// Return the average number of boxes of the upper level that a ray through the whole meets
/// (surface area heuristic). 0 if there are none, or all lie on a line.
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
