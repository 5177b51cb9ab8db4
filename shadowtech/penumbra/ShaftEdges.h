#pragma once

#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/LightShaft.h"
#include "shadowtech/penumbra/RayStarts.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace gnomon
{

/// Bounds of rounding at edges (docs/theory/exact_penumbrae.md).
namespace EdgeRounding
{
/// The unit roundoff of float, 2^-24.
constexpr double unit = 1.0 / 16777216.0;
/// Bounds the side on which a ray passes an edge, in roundings of the edge's length times the
/// distance of its triangles' farthest corner.
constexpr double ofSide = 40.0;
/// Edge-on limit, in roundings of the squared distance of a triangle's farthest corner. If the
/// triangle's height times the start's height above its plane is less, it is seen edge-on. All of
/// it is then close to its edges.
constexpr double ofHeight = 1024.0;
/// Factor by which strips at edges of triangles seen edge-on are wider.
constexpr double wider = 64.0;
/// Return how far beyond an edge's ends the lines of two sides of a triangle stay close, as a
/// slope.
/// @param half distance that counts as close
/// @param longestSlope bound of the length of (x, y, 1) over all rays
/// @param farthest distance of the triangle's farthest corner
/// @param height above its plane, times its least height, over its longest side
inline double beyond(double half, double longestSlope, double farthest, double height)
{
  return 2.0 * half * longestSlope * longestSlope * (1.0 + farthest / height);
}
} // namespace EdgeRounding

/// Return how many triangles this one adds to rays on the left of an edge that it runs along.
/// @param behind true if the rays start behind it
inline float weightOf(const EdgeTriangle& triangle, bool behind)
{
  return behind ? 1.0f : triangle.oneSided ? 0.0f : -1.0f;
}

/// Return 1 if a triangle runs along an edge, -1 if against it.
/// @param triangle 0 or 1, for the first or the second of the edge
inline float directionOf(const TreeEdge& edge, std::size_t triangle)
{
  return triangle == 0 || edge.sameDirection ? 1.0f : -1.0f;
}

/// The edges in a shaft, in its coordinates, at which casters may seem to end from some starts of
/// rays.
class ShaftEdges
{
public:
  struct Edge
  {
    const TreeEdge* edge;
    /// Its triangles; `none` for those that no ray meets.
    std::array<std::uint32_t, 2> triangles;
    /// How many more triangles rays on its left meet than rays on its right; NaN if that differs
    /// between starts.
    float weight;
    /// The least height of a start above its triangles' planes, over their longest side. Valid
    /// unless `weight` is NaN.
    float height;
    /// True for a side of its first triangle that is no edge here. Only rounding close to it
    /// matters.
    bool strip;
  };

  /// The result of a search.
  enum class Found
  {
    All,
    TooMany,
    /// Something other than edges matters: holes, instances, needles, or casters at the light.
    Unclear
  };
  /// Find the edges of a shaft.
  /// @param starts of the shaft, centred; must stay valid during find()
  /// @param most the largest number of edges that is not too many
  Found find(
    const EdgeTree& tree, const LightShaft& shaft, const RayStarts& starts, std::size_t most);

  std::size_t size() const { return this->edges_.size(); }
  const Edge& edge(std::size_t number) const { return this->edges_[number]; }
  glm::dvec3 from(std::size_t number) const
  {
    return { this->ends_[0][number], this->ends_[1][number], this->ends_[2][number] };
  }
  glm::dvec3 to(std::size_t number) const
  {
    return { this->ends_[3][number], this->ends_[4][number], this->ends_[5][number] };
  }

  /// Select the edges that may be in the shaft of one of the starts.
  /// @param slopes of the start's rays
  /// @param numbers receives the edges' numbers
  void select(
    const glm::dvec3& start, const LightShaft::Slopes& slopes, std::vector<std::uint32_t>& numbers);

private:
  Found visit(std::uint32_t number);
  bool isAlike(const Bounds& bounds, const EdgeTree::Cone& cone) const;
  Found take(const BvhRecord& record);
  void takeEdge(const TreeEdge& edge);

  /// A triangle as all starts see it.
  struct Sight
  {
    double behind; ///< EdgeTriangle::behind() of the middle of the starts
    /// The least height of a start above its plane, over its longest side; may be below 0.
    double height;
    bool alike;   ///< true if all starts certainly see the same side
    bool left;    ///< true if all rays certainly leave its plane, so that none meets it
    double width; ///< of the strips at its edges in which rounding matters
  };
  const Sight& look(std::uint32_t number);
  Sight sightOf(const EdgeTriangle& triangle, std::uint32_t number) const;
  bool isLeft(std::uint32_t number) const;

  /// Bounds of where rounding matters around a line, as seen from any of the starts.
  struct Closeness
  {
    double uncertain; ///< as for LightShaft::passes()
    double slopes;    ///< the same as a slope around the edge
  };
  Closeness closeness(const glm::dvec3& from, const glm::dvec3& to, double length, double reach,
    double width, double height) const;
  void takeStrip(std::uint32_t triangle, std::size_t side, const std::array<glm::dvec3, 3>& placed,
    const Sight& sight);
  void add(const Edge& edge, const glm::dvec3& from, const glm::dvec3& to, const Closeness& close);

  /// A cached sight. Triangles are looked up with each of their edges.
  struct Looked
  {
    std::uint64_t search = 0; ///< the search that made it
    std::uint32_t number = 0;
    Sight sight;
  };

  std::uint64_t search_ = 0;   ///< number of the present search
  std::vector<Looked> looked_; ///< by the triangle's number modulo its size
  const EdgeTree* tree_ = nullptr;
  const LightShaft* shaft_ = nullptr;
  const RayStarts* starts_ = nullptr; ///< only valid during find()
  glm::dvec3 centre_, half_;          ///< of the starts' box, centred
  double radius_ = 0.0;
  std::size_t most_ = 0;
  bool fewTriangles_ = false; ///< true if a tracer may test all triangles without their boxes
  std::vector<Edge> edges_;
  std::array<std::vector<double>, 6>
    ends_;                        ///< x, y, z of where edges begin, then of where they end
  std::vector<double> uncertain_; ///< bounds rounding of the side, as for LightShaft::passes()
  ///@{
  /// Slope beyond the rays' slopes up to which the edge matters. `anywhere_` is infinite if it
  /// matters for all rays, else 0.
  std::vector<double> more_;
  std::vector<double> anywhere_;
  ///@}
  std::deque<TreeEdge> strips_;
  std::vector<std::uint8_t> selected_;
};

} // namespace gnomon
