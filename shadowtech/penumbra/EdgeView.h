#pragma once

#include "shadowtech/penumbra/EdgeSums.h"
#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/LightShaft.h"
#include "shadowtech/penumbra/ShaftEdges.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace gnomon
{

/// Projects edges to what is seen from a start.
class EdgeView
{
public:
  EdgeView(const EdgeTree& tree, const LightShaft& shaft, const glm::vec3& start)
    : tree_(tree)
    , shaft_(shaft)
    , start_(start)
    , startShaft_(shaft.toShaft(start))
    , slopes_(shaft.slopes(startShaft_))
    , longestSlope_(
        std::sqrt(1.0 + square(std::max(std::abs(slopes_.least.x), std::abs(slopes_.most.x))) +
          square(std::max(std::abs(slopes_.least.y), std::abs(slopes_.most.y)))))
  {
  }

  const LightShaft::Slopes& slopes() const { return this->slopes_; }
  const glm::dvec3& startShaft() const { return this->startShaft_; }

  /// @return nothing if the edge is not seen, or rays meet equally many triangles on both sides
  std::optional<SeenEdge> operator()(const ShaftEdges& edges, std::uint32_t number) const
  {
    const ShaftEdges::Edge& edge = edges.edge(number);
    const glm::dvec3 from = edges.from(number) - this->startShaft_;
    const glm::dvec3 to = edges.to(number) - this->startShaft_;
    const double squared = std::max(glm::dot(from, from), glm::dot(to, to));
    Look look{ std::sqrt(squared) + edge.edge->reach, edge.weight, 1.0, edge.height };
    if (std::isnan(edge.weight))
    {
      this->lookAtTriangles(edge, look);
      if (look.weight == 0.0f && look.width == 1.0 && !edge.strip && !look.oneIsLeft)
      {
        return std::nullopt;
      }
    }
    look.weight = edge.strip ? 0.0f : look.weight;
    return this->see(*edge.edge, from, to, look);
  }

private:
  static double square(double x) { return x * x; }

  /// Facts about an edge that follow from its triangles.
  struct Look
  {
    double farthest; ///< the distance of their farthest corner
    float weight;    ///< SeenEdge::weight
    /// Width of the strip in which rounding matters; 1 if no triangle is seen edge-on.
    double width;
    /// The least height above their planes over their longest side; 0 if one is seen edge-on.
    double height;
    /// True if rays leave one triangle and may meet the other. Then rounding at the edge alone
    /// decides whether they do.
    bool oneIsLeft = false;
  };

  void lookAtTriangles(const ShaftEdges::Edge& edge, Look& look) const
  {
    look.weight = 0.0f;
    look.height = std::numeric_limits<double>::infinity();
    bool anyLeft = false;
    bool anyMet = false;
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (edge.triangles[i] == TreeEdge::none)
      {
        continue;
      }
      const EdgeTriangle& triangle = this->tree_.triangle(edge.triangles[i]);
      const double behind = triangle.behind(this->start_);
      look.weight += directionOf(*edge.edge, i) * weightOf(triangle, behind > 0.0);
      const bool fromSide = !(std::abs(behind) >
        EdgeRounding::ofHeight * EdgeRounding::unit * look.farthest * look.farthest);
      if (fromSide && this->isLeft(edge.triangles[i], behind))
      {
        anyLeft = true;
        continue; // rounding cannot make rays hit it
      }
      anyMet = true;
      look.height = fromSide ? 0.0 : std::min(look.height, std::abs(behind) / triangle.longest);
      if (fromSide)
      {
        look.width = std::max({ look.width, EdgeRounding::wider,
          static_cast<double>(triangle.longest / triangle.height) });
      }
    }
    look.oneIsLeft = anyLeft && anyMet;
  }

  /// Return true if certainly no ray meets a triangle, rounding included.
  bool isLeft(std::uint32_t number, double behind) const
  {
    const EdgeTriangle& triangle = this->tree_.triangle(number);
    return triangle.isLeft(glm::dvec2(behind), this->tree_.reach(number, this->start_),
      this->shaft_.extentAlong(triangle.normal, this->slopes_), this->longestSlope_);
  }

  /// Return where an edge begins after clipping to where the rays start and end.
  /// @param least z that is left
  /// @param end depth that is left
  glm::dvec3 cut(const glm::dvec3& from, const glm::dvec3& to, double least, double end) const
  {
    glm::dvec3 cut = from;
    if (cut.z < least)
    {
      cut += std::clamp((least - cut.z) / (to.z - cut.z), 0.0, 1.0) * (to - cut);
      cut.z = std::max(cut.z, least);
    }
    const double depth = this->shaft_.endDepth(cut);
    if (depth > end)
    {
      cut += std::clamp((end - depth) / (this->shaft_.endDepth(to) - depth), 0.0, 1.0) * (to - cut);
    }
    return cut;
  }

  /// Return true if an edge, as seen, passes all rays by.
  /// @param around how far around its seen ends it matters
  bool passes(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec3& across,
    double uncertain, double around) const
  {
    for (int i = 0; i < 2; ++i)
    {
      if (std::max(from[i], to[i]) + around < this->slopes_.least[i] ||
        std::min(from[i], to[i]) - around > this->slopes_.most[i])
      {
        return true;
      }
    }
    const glm::dvec2 middle = 0.5 * (this->slopes_.least + this->slopes_.most);
    const glm::dvec2 half = this->slopes_.most - middle;
    return std::abs(glm::dot(across, glm::dvec3(middle, 1.0))) >
      std::abs(across.x) * half.x + std::abs(across.y) * half.y + uncertain;
  }

  std::optional<SeenEdge> see(
    const TreeEdge& edge, const glm::dvec3& from, const glm::dvec3& to, const Look& look) const
  {
    const double end = this->shaft_.firstEnd() - this->shaft_.endDepth(this->startShaft_);
    const double least = 1e-9 * look.farthest;
    const bool beyondLight = this->shaft_.endDepth(from) > end && this->shaft_.endDepth(to) > end;
    const bool behindStart = from.z < least && to.z < least;
    if (beyondLight && look.height > 0.0)
    {
      return std::nullopt;
    }
    glm::dvec3 across = glm::cross(from, to);
    const double uncertain = EdgeRounding::ofSide * EdgeRounding::unit * look.width *
      this->longestSlope_ * edge.length * look.farthest;
    // The lines of two sides at a small angle stay close beyond the edge's ends.
    const double half = uncertain / glm::length(glm::dvec2(across));
    const double beyond =
      EdgeRounding::beyond(half, this->longestSlope_, look.farthest, look.height);
    const bool everywhere = behindStart || !(beyond < 1e30);
    const glm::dvec3 cutFrom = this->cut(from, to, least, end);
    const glm::dvec3 cutTo = this->cut(to, from, least, end);
    glm::dvec2 lower(cutFrom.x / cutFrom.z, cutFrom.y / cutFrom.z);
    glm::dvec2 upper(cutTo.x / cutTo.z, cutTo.y / cutTo.z);
    if (this->passes(lower, upper, across, uncertain,
          everywhere ? std::numeric_limits<double>::infinity() : half + beyond))
    {
      return std::nullopt;
    }
    const bool swapped = static_cast<float>(lower.y) > static_cast<float>(upper.y);
    if (swapped)
    {
      std::swap(lower, upper);
      across = -across;
    }
    const bool counts = !beyondLight && !behindStart;
    const auto weight = static_cast<std::int32_t>(!counts ? 0.0f
        : swapped                                         ? -look.weight
                                                          : look.weight);
    SeenEdge seen;
    seen.across = across;
    seen.uncertain = static_cast<float>(uncertain);
    seen.weight = weight;
    seen.lower = static_cast<float>(lower.y);
    seen.upper = static_cast<float>(upper.y);
    seen.uncertainLower = everywhere ? -3e38f : static_cast<float>(lower.y - beyond);
    seen.uncertainUpper = everywhere ? 3e38f : static_cast<float>(upper.y + beyond);
    seen.weightBelow = 0;
    seen.below = 0.0f;
    // The part beyond the largest x is counted along that line.
    const double border = this->slopes_.most.x;
    const bool lowerIn = lower.x <= border;
    const bool upperIn = upper.x <= border;
    if (lowerIn != upperIn)
    {
      auto crossing = static_cast<float>(-(across.x * border + across.z) / across.y);
      crossing = crossing > seen.lower ? std::min(crossing, seen.upper) : seen.lower;
      seen.below = crossing;
      seen.weightBelow = lowerIn ? -weight : weight;
      (lowerIn ? seen.upper : seen.lower) = crossing;
    }
    else if (!lowerIn)
    {
      seen.upper = seen.lower;
    }
    return seen;
  }

  const EdgeTree& tree_;
  const LightShaft& shaft_;
  glm::dvec3 start_, startShaft_;
  LightShaft::Slopes slopes_;
  double longestSlope_;
};

} // namespace gnomon
