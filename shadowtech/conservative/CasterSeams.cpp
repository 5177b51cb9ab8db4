#include "shadowtech/conservative/CasterSeams.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/WeldedVertices.h"

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

/// A rim by the places of its ends, the lesser one first.
struct PlacedRim
{
  std::array<Place, 2> ends;
  std::uint32_t surface;
  std::uint32_t number; ///< of the surface's rims
  bool swapped;         ///< the edge leads from the greater one

  bool operator<(const PlacedRim& other) const
  {
    return std::tie(this->ends, this->surface, this->number) <
      std::tie(other.ends, other.surface, other.number);
  }
};

/// Twice a triangle's area along its normal.
glm::dvec3 areaOf(const Occluders& occluders, std::uint32_t triangle)
{
  const glm::uvec3 corners = occluders.triangles[triangle];
  const glm::dvec3 a = occluders.positionsCentred[corners.x];
  return glm::cross(glm::dvec3(occluders.positionsCentred[corners.y]) - a,
    glm::dvec3(occluders.positionsCentred[corners.z]) - a);
}

/// What is around a vertex at one of the surfaces that meet there.
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

/// Whether a triangle runs through an edge from its `from` to its `to`.
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
  tbb::parallel_sort(rims.begin(), rims.end());
  return rims;
}

/// Whether triangles of two cones are too far apart for shadow rays that start off one of them.
bool tooFarApart(const NormalCone& a, const NormalCone& b)
{
  const auto angle = [](float cosine)
  { return std::acos(glm::clamp(static_cast<double>(cosine), -1.0, 1.0)); };
  // Rounding a cosine to float changes its angle by up to 4e-4. Written so that NaN is too far apart.
  return !(angle(std::abs(glm::dot(a.axis, b.axis))) + angle(a.leastCosine) + angle(b.leastCosine) <
    std::acos(sharpCosine) - 2e-3);
}

/// The places at which triangles of surfaces that meet there are too far apart, in order.
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
  // Each surface has one cone at a place.
  const auto isSame = [](const PlacedCone& a, const PlacedCone& b)
  { return a.place == b.place && a.surface == b.surface; };
  cones.erase(std::unique(cones.begin(), cones.end(), isSame), cones.end());
  std::vector<Place> sharp;
  for (std::size_t first = 0; first < cones.size();)
  {
    std::size_t last = first;
    bool apart = false;
    for (; last < cones.size() && cones[last].place == cones[first].place; ++last)
    {
      for (std::size_t i = first; i <= last && !apart; ++i)
      {
        apart = tooFarApart(cones[i].cone, cones[last].cone);
      }
    }
    if (apart)
    {
      sharp.push_back(cones[first].place);
    }
    first = last;
  }
  return sharp;
}

} // namespace

//------------------------------------------------------------------------------
void CasterSeams::update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges)
{
  this->bySurface_.assign(occluders.surfaces.size(), {});
  const std::vector<PlacedRim> rims = placedRims(occluders, edges);
  std::vector<std::pair<PlacedRim, PlacedRim>> pairs;
  for (std::size_t first = 0; first < rims.size();)
  {
    std::size_t last = first + 1;
    while (last < rims.size() && rims[last].ends == rims[first].ends)
    {
      ++last;
    }
    if (last - first == 2)
    {
      pairs.emplace_back(rims[first], rims[first + 1]);
    }
    first = last;
  }
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

//------------------------------------------------------------------------------
const Seam* CasterSeams::at(std::size_t surface, std::uint32_t edge) const
{
  const std::vector<Seam>& seams = this->bySurface_[surface];
  const auto found = std::lower_bound(seams.begin(), seams.end(), edge,
    [](const Seam& seam, std::uint32_t number) { return seam.edge < number; });
  return found != seams.end() && found->edge == edge ? &*found : nullptr;
}

//------------------------------------------------------------------------------
std::size_t CasterSeams::bytes() const
{
  std::size_t bytes = bytesOf(this->bySurface_);
  for (const std::vector<Seam>& seams : this->bySurface_)
  {
    bytes += bytesOf(seams);
  }
  return bytes;
}

} // namespace gnomon
