#include "shadowtech/mesh/CasterSeams.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/WeldedVertices.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace gnomon
{
namespace
{

/// A rim with the places of its ends, the lesser place first.
struct PlacedRim
{
  std::array<Place, 2> ends;
  std::uint32_t surface;
  std::uint32_t number; ///< index into the surface's rims
  bool swapped;         ///< true if the edge leads from the greater place
};

/// Return the triangle's normal, as long as twice its area.
glm::dvec3 areaOf(const Occluders& occluders, std::uint32_t triangle)
{
  const glm::uvec3 corners = occluders.triangles[triangle];
  const glm::dvec3 a = occluders.positionsCentred[corners.x];
  return glm::cross(glm::dvec3(occluders.positionsCentred[corners.y]) - a,
    glm::dvec3(occluders.positionsCentred[corners.z]) - a);
}

/// The normals around a vertex at one of the surfaces that meet there.
struct PlacedCone
{
  Place place;
  std::uint32_t surface;
  NormalCone cone;

  bool operator<(const PlacedCone& other) const
  {
    return std::tie(this->place, this->surface) < std::tie(other.place, other.surface);
  }
};

bool mayHaveSeams(const Surface& surface)
{
  return surface.casts && !surface.isInstanced() && !surface.oneSided && !surface.cutout;
}

/// Return true if the edge's first triangle runs from its `from` to its `to`.
bool runsAlong(const Occluders& occluders, const CasterEdge& edge)
{
  const Place from = placeOf(occluders.positionsCentred[edge.from]);
  const Place to = placeOf(occluders.positionsCentred[edge.to]);
  const glm::uvec3 corners = occluders.triangles[edge.triangles[0]];
  for (int k = 0; k < 3; ++k)
  {
    if (placeOf(occluders.positionsCentred[corners[k]]) == from &&
      placeOf(occluders.positionsCentred[corners[(k + 1) % 3]]) == to)
    {
      return true;
    }
  }
  return false;
}

std::vector<PlacedRim> placedRims(
  const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges)
{
  std::vector<PlacedRim> rims;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (!mayHaveSeams(occluders.surfaces[i]))
    {
      continue;
    }
    const SurfaceEdges& found = *edges[i];
    for (std::uint32_t number = 0; number < found.rims.size(); ++number)
    {
      const CasterEdge& edge = found.edges[found.rims[number].edge];
      const Place from = placeOf(occluders.positionsCentred[edge.from]);
      const Place to = placeOf(occluders.positionsCentred[edge.to]);
      rims.push_back({ { { std::min(from, to), std::max(from, to) } },
        static_cast<std::uint32_t>(i), number, to < from });
    }
  }
  return rims;
}

/// Return the pairs of rims between the same places, where no third rim lies.
std::vector<std::pair<PlacedRim, PlacedRim>> pairsOf(const std::vector<PlacedRim>& rims)
{
  // Counts rims between the same places, stored at the first of them.
  struct Same
  {
    std::uint32_t count = 0;
    std::uint32_t last = 0;
  };
  std::vector<Same> same(rims.size());
  FirstOfSame first(rims.size());
  for (std::uint32_t i = 0; i < rims.size(); ++i)
  {
    const std::array<Place, 2>& ends = rims[i].ends;
    Same& sameAsThis = same[first.of(i, hashOf(ends[0]) + 3 * hashOf(ends[1]),
      [&](std::uint32_t other) { return rims[other].ends == ends; })];
    ++sameAsThis.count;
    sameAsThis.last = i;
  }
  std::vector<std::pair<PlacedRim, PlacedRim>> pairs;
  for (std::size_t i = 0; i < rims.size(); ++i)
  {
    if (same[i].count == 2)
    {
      pairs.emplace_back(rims[i], rims[same[i].last]);
    }
  }
  return pairs;
}

/// A cone around normals of either sign, with its half angle in radians.
class WideCone
{
public:
  explicit WideCone(const NormalCone& cone)
    : axis_(glm::normalize(glm::dvec3(cone.axis)))
    , halfAngle_(std::acos(glm::clamp(static_cast<double>(cone.leastCosine), -1.0, 1.0)))
  {
  }

  double halfAngle() const { return this->halfAngle_; }

  /// Return the largest angle between this cone's axis and a normal of the other cone.
  double reachOf(const WideCone& other) const { return this->angleTo(other) + other.halfAngle_; }

  /// Widen to the narrowest cone around both. The result is NaN if the other cone is.
  void add(const WideCone& other)
  {
    const double angle = this->angleTo(other);
    if (angle + other.halfAngle_ <= this->halfAngle_)
    {
      return;
    }
    if (angle + this->halfAngle_ <= other.halfAngle_)
    {
      *this = other;
      return;
    }
    const double halfAngle = 0.5 * (this->halfAngle_ + angle + other.halfAngle_);
    const double by = halfAngle - this->halfAngle_;
    const glm::dvec3 towards =
      glm::dot(this->axis_, other.axis_) < 0.0 ? -other.axis_ : other.axis_;
    // The sum is not zero: the angle is not, as neither cone holds the other.
    this->axis_ = glm::normalize(std::sin(angle - by) * this->axis_ + std::sin(by) * towards);
    this->halfAngle_ = halfAngle;
  }

private:
  double angleTo(const WideCone& other) const
  {
    return std::acos(glm::min(std::abs(glm::dot(this->axis_, other.axis_)), 1.0));
  }

  glm::dvec3 axis_;
  double halfAngle_;
};

/// Return true if the normals of the cones fit into no cone of half the angle of sharpCosine.
/// Shadow rays that start off one triangle may then begin behind another.
///
/// The method is Ritter's for bounding spheres (An efficient bounding sphere, 1990): start from two
/// cones that are far apart, then widen by the others. For two cones alone the result is exact.
bool tooFarApart(const std::vector<WideCone>& cones)
{
  const auto farthestFrom = [&](const WideCone& one)
  {
    return *std::max_element(cones.begin(), cones.end(),
      [&](const WideCone& a, const WideCone& b) { return one.reachOf(a) < one.reachOf(b); });
  };
  WideCone all = farthestFrom(cones.front());
  all.add(farthestFrom(all));
  for (const WideCone& cone : cones)
  {
    all.add(cone);
  }
  // Rounding a cosine to float changes its angle by up to 4e-4. NaN must count as too far apart.
  return !(all.halfAngle() < 0.5 * std::acos(sharpCosine) - 1e-3);
}

/// Return, sorted, the places where the normals of the surfaces that meet are too far apart.
std::vector<Place> sharpPlaces(const std::vector<std::pair<PlacedRim, PlacedRim>>& pairs,
  const std::vector<const SurfaceEdges*>& edges)
{
  std::vector<PlacedCone> cones;
  cones.reserve(4 * pairs.size());
  const auto add = [&](const PlacedRim& rim)
  {
    const Rim& found = edges[rim.surface]->rims[rim.number];
    for (std::size_t end = 0; end < 2; ++end)
    {
      cones.push_back({ rim.ends[end], rim.surface, found.corners[rim.swapped ? 1 - end : end] });
    }
  };
  for (const auto& [one, other] : pairs)
  {
    add(one);
    add(other);
  }
  tbb::parallel_sort(cones.begin(), cones.end());
  // Each surface has one cone per place.
  const auto isSame = [](const PlacedCone& a, const PlacedCone& b)
  { return a.place == b.place && a.surface == b.surface; };
  cones.erase(std::unique(cones.begin(), cones.end(), isSame), cones.end());
  std::vector<Place> sharp;
  std::vector<WideCone> atPlace;
  for (std::size_t first = 0; first < cones.size();)
  {
    atPlace.clear();
    std::size_t last = first;
    for (; last < cones.size() && cones[last].place == cones[first].place; ++last)
    {
      atPlace.emplace_back(cones[last].cone);
    }
    if (tooFarApart(atPlace))
    {
      sharp.push_back(cones[first].place);
    }
    first = last;
  }
  return sharp;
}

} // namespace

void CasterSeams::update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges)
{
  this->bySurface_.assign(occluders.surfaces.size(), {});
  const std::vector<std::pair<PlacedRim, PlacedRim>> pairs = pairsOf(placedRims(occluders, edges));
  const std::vector<Place> sharp = sharpPlaces(pairs, edges);
  const auto isSharp = [&](const Place& place)
  { return std::binary_search(sharp.begin(), sharp.end(), place); };
  const auto edgeOf = [&](const PlacedRim& rim)
  { return edges[rim.surface]->rims[rim.number].edge; };
  for (const auto& [one, other] : pairs)
  {
    const CasterEdge& edge = edges[one.surface]->edges[edgeOf(one)];
    const CasterEdge& otherEdge = edges[other.surface]->edges[edgeOf(other)];
    const bool sameDirection = (runsAlong(occluders, edge) != one.swapped) ==
      (runsAlong(occluders, otherEdge) != other.swapped);
    const glm::dvec3 area = areaOf(occluders, edge.triangles[0]);
    const glm::dvec3 otherArea = areaOf(occluders, otherEdge.triangles[0]);
    const double cosine = (sameDirection ? -1.0 : 1.0) * glm::dot(area, otherArea) /
      (glm::length(area) * glm::length(otherArea));
    const bool sharpSeam = !(cosine > sharpCosine) || isSharp(one.ends[0]) || isSharp(one.ends[1]);
    this->bySurface_[one.surface].push_back(
      { edgeOf(one), other.surface, otherEdge.triangles[0], sameDirection, sharpSeam });
    this->bySurface_[other.surface].push_back(
      { edgeOf(other), one.surface, edge.triangles[0], sameDirection, sharpSeam });
  }
  for (std::vector<Seam>& seams : this->bySurface_)
  {
    std::sort(
      seams.begin(), seams.end(), [](const Seam& a, const Seam& b) { return a.edge < b.edge; });
  }
}

const Seam* CasterSeams::at(std::size_t surface, std::uint32_t edge) const
{
  const std::vector<Seam>& seams = this->bySurface_[surface];
  const auto found = std::lower_bound(seams.begin(), seams.end(), edge,
    [](const Seam& seam, std::uint32_t number) { return seam.edge < number; });
  return found != seams.end() && found->edge == edge ? &*found : nullptr;
}

std::size_t CasterSeams::bytes() const
{
  return bytesOf(this->bySurface_) + bytesOfAll(this->bySurface_, bytesOf<Seam>);
}

} // namespace gnomon
