#include "shadowtech/penumbra/ShaftEdges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{
//------------------------------------------------------------------------------
ShaftEdges::Found ShaftEdges::find(const EdgeTree& tree, const LightShaft& shaft, std::size_t most)
{
  this->most_ = most;
  this->tree_ = &tree;
  this->shaft_ = &shaft;
  this->centre_ = shaft.starts().centre();
  this->half_ = shaft.starts().upper - this->centre_;
  this->radius_ = glm::length(this->half_);
  this->edges_.clear();
  for (std::vector<double>& ends : this->ends_)
  {
    ends.clear();
  }
  this->uncertain_.clear();
  return tree.empty() ? Found::All : this->visit(tree.root());
}

//------------------------------------------------------------------------------
ShaftEdges::Found ShaftEdges::visit(std::uint32_t link)
{
  if (BvhLink::isLeaf(link))
  {
    for (std::uint32_t i = 0; i < BvhLink::count(link); ++i)
    {
      const Found found = this->take(this->tree_->record(BvhLink::first(link) + i));
      if (found != Found::All)
      {
        return found;
      }
    }
    return Found::All;
  }
  for (std::uint32_t child = link; child < link + 2; ++child)
  {
    const BvhNode& node = this->tree_->node(child);
    const Bounds bounds{ glm::dvec3(node.lower), glm::dvec3(node.upper) };
    const bool matters = this->shaft_->mayMeet(bounds) &&
      (!this->isAlike(bounds, this->tree_->cone(child)) || this->shaft_->mayReachEnds(bounds));
    const Found found = matters ? this->visit(node.link) : Found::All;
    if (found != Found::All)
    {
      return found;
    }
  }
  return Found::All;
}

//------------------------------------------------------------------------------
/// Whether all starts are on the same side of all triangles of a part of the tree.
bool ShaftEdges::isAlike(const Bounds& bounds, const EdgeTree::Cone& cone) const
{
  if (!(cone.cosine > 0.0f))
  {
    return false;
  }
  const glm::dvec3 centre = bounds.centre();
  const glm::dvec3 towards = centre - this->centre_;
  const glm::dvec3 half = bounds.upper - centre + this->half_;
  const glm::dvec3 axis(cone.axis);
  const double along = glm::dot(axis, towards);
  const double least = std::abs(along) - glm::dot(glm::abs(axis), half);
  if (!(least > 0.0))
  {
    return false;
  }
  const double radius = glm::length(half);
  const double squared = glm::dot(towards, towards);
  const double across = std::sqrt(std::max(squared - along * along, 0.0)) + radius;
  const double farthest = std::sqrt(squared) + radius + cone.reach;
  return least * cone.cosine - across * cone.sine >
    EdgeRounding::ofHeight * EdgeRounding::unit * farthest * farthest * cone.mostPerHeight;
}

//------------------------------------------------------------------------------
ShaftEdges::Found ShaftEdges::take(const EdgeTree::Record& record)
{
  if (record.opaque)
  {
    return this->shaft_->mayMeet(this->tree_->bounds(record)) ? Found::Unclear : Found::All;
  }
  const std::array<glm::vec3, 3>& corners = this->tree_->corners(record.number);
  const std::array<glm::dvec3, 3> placed{ { this->shaft_->toShaft(corners[0]),
    this->shaft_->toShaft(corners[1]), this->shaft_->toShaft(corners[2]) } };
  if (!this->shaft_->mayMeet(placed))
  {
    return Found::All;
  }
  const auto [nearest, farthest] = std::minmax({ this->shaft_->endDepth(placed[0]),
    this->shaft_->endDepth(placed[1]), this->shaft_->endDepth(placed[2]) });
  if (nearest > this->shaft_->lastEnd())
  {
    return Found::All; // beyond the light
  }
  if (farthest >= this->shaft_->firstEnd())
  {
    return Found::Unclear; // rays may end on it
  }
  for (std::uint32_t i = 0; i < record.edgeCount; ++i)
  {
    this->takeEdge(this->tree_->edge(record.firstEdge + i));
  }
  return this->edges_.size() <= this->most_ ? Found::All : Found::TooMany;
}

//------------------------------------------------------------------------------
void ShaftEdges::takeEdge(const TreeEdge& edge)
{
  const glm::dvec3 from = this->shaft_->toShaft(edge.from);
  const glm::dvec3 to = this->shaft_->toShaft(edge.to);
  if (!this->shaft_->mayMeet(std::array<glm::dvec3, 2>{ { from, to } }) ||
    this->shaft_->passes(from, to, edge.length))
  {
    return;
  }
  Edge taken{ &edge, 0.0f, std::numeric_limits<float>::infinity() };
  for (std::size_t i = 0; i < 2 && edge.triangles[i] != TreeEdge::none; ++i)
  {
    const EdgeTriangle& triangle = this->tree_->triangle(edge.triangles[i]);
    const double behind = triangle.behind(this->centre_);
    const double least = std::abs(behind) - glm::dot(glm::abs(triangle.normal), this->half_);
    const double farthest =
      glm::length(glm::dvec3(triangle.corner) - this->centre_) + triangle.longest + this->radius_;
    const bool alike = least > EdgeRounding::ofHeight * EdgeRounding::unit * farthest * farthest;
    taken.weight += alike ? directionOf(edge, i) * weightOf(triangle, behind > 0.0)
                          : std::numeric_limits<float>::quiet_NaN();
    taken.height = std::min(taken.height, static_cast<float>(least / triangle.longest));
  }
  if (taken.weight == 0.0f)
  {
    return;
  }
  this->edges_.push_back(taken);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto axis = static_cast<glm::length_t>(i);
    this->ends_[i].push_back(from[axis]);
    this->ends_[i + 3].push_back(to[axis]);
  }
  const double farthest =
    std::sqrt(std::max(glm::dot(from, from), glm::dot(to, to))) + this->radius_ + edge.reach;
  this->uncertain_.push_back(
    4.0 * EdgeRounding::ofSide * EdgeRounding::unit * EdgeRounding::wider * edge.length * farthest);
}

//------------------------------------------------------------------------------
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void ShaftEdges::select(const glm::dvec3& start, const LightShaft::Slopes& slopes,
  std::vector<std::uint32_t>& numbers)
{
  const std::size_t count = this->edges_.size();
  this->selected_.resize(count);
  const double* const fromX = this->ends_[0].data();
  const double* const fromY = this->ends_[1].data();
  const double* const fromZ = this->ends_[2].data();
  const double* const toX = this->ends_[3].data();
  const double* const toY = this->ends_[4].data();
  const double* const toZ = this->ends_[5].data();
  const double* const uncertain = this->uncertain_.data();
  std::uint8_t* const selected = this->selected_.data();
  const double leastX = slopes.least.x, leastY = slopes.least.y;
  const double mostX = slopes.most.x, mostY = slopes.most.y;
  const double middleX = 0.5 * (leastX + mostX), middleY = 0.5 * (leastY + mostY);
  const double halfX = mostX - middleX, halfY = mostY - middleY;
  const double startX = start.x, startY = start.y, startZ = start.z;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i)
  {
    const double ax = fromX[i] - startX, ay = fromY[i] - startY, az = fromZ[i] - startZ;
    const double bx = toX[i] - startX, by = toY[i] - startY, bz = toZ[i] - startZ;
    // The farther inside of the two of each side.
    const double right = std::min(ax - mostX * az, bx - mostX * bz);
    const double left = std::min(leastX * az - ax, leastX * bz - bx);
    const double above = std::min(ay - mostY * az, by - mostY * bz);
    const double below = std::min(leastY * az - ay, leastY * bz - by);
    const double before = std::min(-az, -bz);
    const double outside =
      std::max(std::max(std::max(right, left), std::max(above, below)), before);
    // And the line between them.
    const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    const double beside = std::abs(x * middleX + y * middleY + z) - std::abs(x) * halfX -
      std::abs(y) * halfY - uncertain[i];
    selected[i] = std::max(outside, beside) > 0.0 ? 0 : 1;
  }
  numbers.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (selected[i] != 0)
    {
      numbers.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

} // namespace gnomon
