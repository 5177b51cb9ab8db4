#include "shadowtech/penumbra/ShaftEdges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// Up to this many triangles may share one leaf of a tracer, which then tests no box.
constexpr std::size_t mostOfLeaf = 32;

/// Size of the cache of sights. Nearly all squares have fewer triangles.
constexpr std::size_t sightsKept = 512;

/// Beyond this slope around an edge, rounding at the edge matters for all rays.
constexpr double mostSlopes = 0.25;

} // namespace

ShaftEdges::Found ShaftEdges::find(
  const EdgeTree& tree, const LightShaft& shaft, const RayStarts& starts, std::size_t most)
{
  this->most_ = most;
  ++this->search_;
  this->looked_.resize(sightsKept);
  this->tree_ = &tree;
  this->shaft_ = &shaft;
  this->starts_ = &starts;
  this->centre_ = shaft.starts().centre();
  this->half_ = shaft.starts().upper - this->centre_;
  this->radius_ = glm::length(this->half_);
  this->edges_.clear();
  for (std::vector<double>& ends : this->ends_)
  {
    ends.clear();
  }
  this->uncertain_.clear();
  this->more_.clear();
  this->anywhere_.clear();
  this->strips_.clear();
  this->fewTriangles_ = tree.size() <= mostOfLeaf;
  if (!this->fewTriangles_)
  {
    return this->visit(0);
  }
  Found found = Found::All;
  for (std::uint32_t place = 0; place < tree.size() && found == Found::All; ++place)
  {
    found = this->take(tree.record(place));
  }
  return found;
}

ShaftEdges::Found ShaftEdges::visit(std::uint32_t number)
{
  const BvhNode& node = this->tree_->node(number);
  const Bounds bounds{ glm::dvec3(node.lower), glm::dvec3(node.upper) };
  if (!this->shaft_->mayMeet(bounds) ||
    (this->isAlike(bounds, this->tree_->cone(number)) && !this->shaft_->mayReachEnds(bounds)))
  {
    return Found::All;
  }
  Found found = Found::All;
  for (std::uint32_t i = node.first;
       i < node.first + (node.count > 0 ? node.count : 2) && found == Found::All; ++i)
  {
    found = node.count > 0 ? this->take(this->tree_->record(i)) : this->visit(i);
  }
  return found;
}

/// Return true if all starts lie on one side of all triangles in a node, and the same for each.
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

ShaftEdges::Found ShaftEdges::take(const BvhRecord& record)
{
  const bool boxMeets = this->shaft_->mayMeet(this->tree_->bounds(record));
  if (record.opaque)
  {
    return boxMeets ? Found::Unclear : Found::All;
  }
  if (!boxMeets && !this->fewTriangles_)
  {
    return Found::All;
  }
  const Sight sight = this->look(record.number); // a copy, as the cache may replace it
  const std::array<glm::vec3, 3>& corners = this->tree_->corners(record.number);
  const std::array<glm::dvec3, 3> placed{ { this->shaft_->toShaft(corners[0]),
    this->shaft_->toShaft(corners[1]), this->shaft_->toShaft(corners[2]) } };
  const auto [nearest, farthest] = std::minmax({ this->shaft_->endDepth(placed[0]),
    this->shaft_->endDepth(placed[1]), this->shaft_->endDepth(placed[2]) });
  const bool beyond = nearest > this->shaft_->lastEnd();
  const bool meets = !beyond && this->shaft_->mayMeet(placed);
  if (meets && !sight.left && farthest >= this->shaft_->firstEnd())
  {
    return Found::Unclear; // rays may end on it
  }
  if (beyond && sight.alike)
  {
    return Found::All;
  }
  for (std::uint32_t i = 0; meets && i < record.edgeCount; ++i)
  {
    this->takeEdge(this->tree_->edge(record.firstEdge + i));
  }
  if (sight.left)
  {
    return Found::All; // rounding at its sides matters for its neighbours only
  }
  // A ray that meets the triangle's box may hit close to the lines of its sides, far from the sides
  // themselves.
  for (std::size_t side = 0; side < 3; ++side)
  {
    if (!meets ||
      !this->shaft_->mayMeet(std::array<glm::dvec3, 2>{ { placed[side], placed[(side + 1) % 3] } }))
    {
      this->takeStrip(record.number, side, placed, sight);
    }
  }
  // Each start sees only few of the strips.
  return this->edges_.size() - this->strips_.size() <= this->most_ ? Found::All : Found::TooMany;
}

const ShaftEdges::Sight& ShaftEdges::look(std::uint32_t number)
{
  Looked& looked = this->looked_[number % sightsKept];
  if (looked.search != this->search_ || looked.number != number)
  {
    looked = { this->search_, number, this->sightOf(this->tree_->triangle(number), number) };
  }
  return looked.sight;
}

ShaftEdges::Sight ShaftEdges::sightOf(const EdgeTriangle& triangle, std::uint32_t number) const
{
  const double behind = triangle.behind(this->centre_);
  const double least = std::abs(behind) - glm::dot(glm::abs(triangle.normal), this->half_);
  const double farthest =
    glm::length(glm::dvec3(triangle.corner) - this->centre_) + triangle.longest + this->radius_;
  const bool alike = least > EdgeRounding::ofHeight * EdgeRounding::unit * farthest * farthest;
  return { behind, least / triangle.longest, alike, !alike && this->isLeft(number),
    alike
      ? 1.0
      : std::max(EdgeRounding::wider, static_cast<double>(triangle.longest / triangle.height)) };
}

/// Return EdgeTriangle::isLeft() for all starts.
bool ShaftEdges::isLeft(std::uint32_t number) const
{
  const EdgeTriangle& triangle = this->tree_->triangle(number);
  const glm::dvec2 along = this->shaft_->extentAlong(triangle.normal);
  if (along.x < 0.0 && along.y > 0.0)
  {
    return false;
  }
  return triangle.isLeft(this->starts_->behind(triangle),
    this->tree_->reach(number, this->centre_) + this->half_, along, this->shaft_->longestSlope());
}

/// @param reach bound of how far from its ends its triangles' corners are
/// @param width the largest Sight::width of its triangles
/// @param height the least Sight::height of its triangles
ShaftEdges::Closeness ShaftEdges::closeness(const glm::dvec3& from, const glm::dvec3& to,
  double length, double reach, double width, double height) const
{
  const double farthest =
    std::sqrt(std::max(glm::dot(from, from), glm::dot(to, to))) + this->radius_ + reach;
  const double longest = this->shaft_->longestSlope();
  const double uncertain =
    EdgeRounding::ofSide * EdgeRounding::unit * width * longest * length * farthest;
  // The edge's length times the least distance of its line.
  const double least = glm::length(glm::cross(from, to)) - this->radius_ * length;
  if (width > 1.0 || !(least > 0.0) || !(height > 0.0))
  {
    return { uncertain, std::numeric_limits<double>::infinity() };
  }
  const double half = uncertain * longest / least;
  return { uncertain, half + EdgeRounding::beyond(half, longest, farthest, height) };
}

/// Add a triangle's side as a strip: only rounding close to its line matters.
void ShaftEdges::takeStrip(std::uint32_t triangle, std::size_t side,
  const std::array<glm::dvec3, 3>& placed, const Sight& sight)
{
  const glm::dvec3& from = placed[side];
  const glm::dvec3& to = placed[(side + 1) % 3];
  const double length = glm::length(to - from);
  const double reach = this->tree_->triangle(triangle).longest;
  const Closeness close = this->closeness(from, to, length, reach, sight.width, sight.height);
  if ((close.slopes < mostSlopes &&
        !this->shaft_->mayMeet(std::array<glm::dvec3, 2>{ { from, to } }, close.slopes)) ||
    this->shaft_->passes(from, to, length, close.uncertain))
  {
    return;
  }
  const std::array<glm::vec3, 3>& corners = this->tree_->corners(triangle);
  TreeEdge strip;
  strip.from = corners[side];
  strip.to = corners[(side + 1) % 3];
  strip.triangles = { { triangle, TreeEdge::none } };
  strip.sameDirection = false;
  strip.length = static_cast<float>(length);
  strip.reach = static_cast<float>(reach);
  this->strips_.push_back(strip);
  this->add({ &this->strips_.back(), this->strips_.back().triangles,
              sight.alike ? 0.0f : std::numeric_limits<float>::quiet_NaN(),
              static_cast<float>(sight.height), true },
    from, to, close);
}

void ShaftEdges::takeEdge(const TreeEdge& edge)
{
  const glm::dvec3 from = this->shaft_->toShaft(edge.from);
  const glm::dvec3 to = this->shaft_->toShaft(edge.to);
  if (!this->shaft_->mayMeet(std::array<glm::dvec3, 2>{ { from, to } }))
  {
    return;
  }
  Edge taken{ &edge, edge.triangles, 0.0f, std::numeric_limits<float>::infinity(), false };
  double width = 1.0;
  for (std::size_t i = 0; i < 2 && edge.triangles[i] != TreeEdge::none; ++i)
  {
    const EdgeTriangle& triangle = this->tree_->triangle(edge.triangles[i]);
    const Sight& sight = this->look(edge.triangles[i]);
    if (sight.left)
    {
      taken.triangles[i] = TreeEdge::none;
      continue;
    }
    taken.weight += sight.alike ? directionOf(edge, i) * weightOf(triangle, sight.behind > 0.0)
                                : std::numeric_limits<float>::quiet_NaN();
    taken.height = std::min(taken.height, static_cast<float>(sight.height));
    width = std::max(width, sight.width);
  }
  if (taken.weight == 0.0f)
  {
    return;
  }
  const Closeness close = this->closeness(from, to, edge.length, edge.reach, width, taken.height);
  if (!this->shaft_->passes(from, to, edge.length, close.uncertain))
  {
    this->add(taken, from, to, close);
  }
}

void ShaftEdges::add(
  const Edge& edge, const glm::dvec3& from, const glm::dvec3& to, const Closeness& close)
{
  this->edges_.push_back(edge);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto axis = static_cast<glm::length_t>(i);
    this->ends_[i].push_back(from[axis]);
    this->ends_[i + 3].push_back(to[axis]);
  }
  const bool anywhere = !(close.slopes < mostSlopes);
  this->uncertain_.push_back(close.uncertain);
  this->more_.push_back(anywhere ? 0.0 : close.slopes);
  this->anywhere_.push_back(anywhere ? std::numeric_limits<double>::infinity() : 0.0);
}

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
  const double* const more = this->more_.data();
  const double* const anywhere = this->anywhere_.data();
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
    // For each side of the shaft, the end that lies farther inside.
    const double moreA = more[i] * az, moreB = more[i] * bz;
    const double right = std::min(ax - mostX * az - moreA, bx - mostX * bz - moreB);
    const double left = std::min(leastX * az - ax - moreA, leastX * bz - bx - moreB);
    const double above = std::min(ay - mostY * az - moreA, by - mostY * bz - moreB);
    const double below = std::min(leastY * az - ay - moreA, leastY * bz - by - moreB);
    const double before = std::min(-az, -bz);
    const double outside =
      std::max(std::max(std::max(right, left), std::max(above, below)), before) - anywhere[i];
    // Test the line between the ends.
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
