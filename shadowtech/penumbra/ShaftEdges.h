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

/// What rounding is to an edge (docs/theory/exact_penumbrae.md).
namespace EdgeRounding
{
/// The unit roundoff of float, 2^-24.
constexpr double unit = 1.0 / 16777216.0;
/// How exactly is known on which side of an edge a ray passes, in roundings of the length of the
/// edge times the distance of its triangles' farthest corner.
constexpr double ofSide = 40.0;
/// From where a triangle's height times the height above its plane is less than so many roundings
/// of the squared distance of its farthest corner, it is seen from its side, and all of it is close
/// to its edges.
constexpr double ofHeight = 1024.0;
/// Where that is so, what is close to its edges is so many times as wide.
constexpr double wider = 64.0;
/// How far beyond an edge's ends the lines of two sides of a triangle stay close, as slopes.
/// @param half how close
/// @param longestSlope of rays (x, y, 1), their length
/// @param farthest the distance of the triangle's farthest corner
/// @param height above its plane, times its least height, over its longest side
inline double beyond(double half, double longestSlope, double farthest, double height)
{
  return 2.0 * half * longestSlope * longestSlope * (1.0 + farthest / height);
}
} // namespace EdgeRounding

/// What a triangle adds to the rays to the left of an edge that it runs along.
/// @param behind whether the rays start behind it
inline float weightOf(const EdgeTriangle& triangle, bool behind)
{
  return behind ? 1.0f : triangle.oneSided ? 0.0f : -1.0f;
}

/// How often a triangle runs along an edge, less how often against it.
/// @param triangle the first or the second of the edge
inline float directionOf(const TreeEdge& edge, std::size_t triangle)
{
  return triangle == 0 || edge.sameDirection ? 1.0f : -1.0f;
}

/// The edges at which casters may seem to end from some starts of rays, as far as they are in these
/// rays' shaft. In its coordinates.
class ShaftEdges
{
public:
  struct Edge
  {
    const TreeEdge* edge;
    /// Its triangles, but for those that no ray meets: these are `none`.
    std::array<std::uint32_t, 2> triangles;
    /// How many triangles more are met to its left than to its right, where that is the same from
    /// all starts; else NaN.
    float weight;
    /// Then, the least height above the plane of its triangles, over their longest side.
    float height;
    /// Whether only what is close to it by rounding matters: it is a side of its first triangle
    /// that is itself no edge here.
    bool strip;
  };

  /// What came of looking for them.
  enum class Found
  {
    All,
    TooMany,
    Unclear ///< something else than edges matters: what has holes, instances, needles, what is at the light
  };
  /// Looks for them.
  /// @param starts of the shaft, centred; read as long as find() takes
  /// @param most of them that are not too many
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

  /// Those that may be in the shaft of one of the starts.
  /// @param slopes of its rays
  /// @param numbers gets them
  void select(
    const glm::dvec3& start, const LightShaft::Slopes& slopes, std::vector<std::uint32_t>& numbers);

private:
  Found visit(std::uint32_t link);
  bool isAlike(const Bounds& bounds, const EdgeTree::Cone& cone) const;
  Found take(const EdgeTree::Record& record);
  void takeEdge(const TreeEdge& edge);

  /// A triangle as all of the starts see it.
  struct Sight
  {
    double behind; ///< EdgeTriangle::behind() of the middle of the starts
    double height; ///< the least above its plane, over its longest side; may be below 0
    bool alike;    ///< whether it shows them the same side for certain
    bool left;     ///< whether all rays leave its plane for certain, so that none meets it
    double width;  ///< of what is close to its edges by rounding
  };
  const Sight& look(std::uint32_t number);
  Sight sightOf(const EdgeTriangle& triangle, std::uint32_t number) const;
  bool isLeft(std::uint32_t number) const;

  /// What is close to a line by rounding, as seen from any of the starts.
  struct Closeness
  {
    double uncertain; ///< as LightShaft::passes() has it
    double slopes;    ///< so far around the edge as such
  };
  Closeness closeness(const glm::dvec3& from, const glm::dvec3& to, double length, double reach,
    double width, double height) const;
  void takeStrip(std::uint32_t triangle, std::size_t side, const std::array<glm::dvec3, 3>& placed,
    const Sight& sight);
  void add(const Edge& edge, const glm::dvec3& from, const glm::dvec3& to, const Closeness& close);

  /// A triangle that was looked at, most of which are again, with each of their edges.
  struct Looked
  {
    std::uint64_t search = 0; ///< in which
    std::uint32_t number = 0;
    Sight sight;
  };

  std::uint64_t search_ = 0;   ///< number of this one
  std::vector<Looked> looked_; ///< by the triangles' numbers, less whole multiples of its size
  const EdgeTree* tree_ = nullptr;
  const LightShaft* shaft_ = nullptr;
  const RayStarts* starts_ = nullptr; ///< while looking
  glm::dvec3 centre_, half_;          ///< of the starts' box, centred
  double radius_ = 0.0;
  std::size_t most_ = 0;
  bool fewTriangles_ = false; ///< which a tracer may ask without looking at their boxes
  std::vector<Edge> edges_;
  std::array<std::vector<double>, 6>
    ends_;                        ///< x, y, z of where edges begin, then of where they end
  std::vector<double> uncertain_; ///< the most that rounding may make of their side
  ///@{
  /// So far beyond the rays' slopes they matter; infinite in the second where they do wherever they
  /// are.
  std::vector<double> more_;
  std::vector<double> anywhere_;
  ///@}
  std::deque<TreeEdge> strips_;
  std::vector<std::uint8_t> selected_;
};

} // namespace gnomon
