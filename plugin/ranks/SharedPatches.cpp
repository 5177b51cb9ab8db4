#include "plugin/ranks/SharedPatches.h"

#include "lights/Hash.h"
#include "shadowtech/base/Bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <unordered_map>
#include <utility>

namespace gnomon
{
namespace
{

/// An edge that ranks recognise.
struct Edge
{
  std::uint32_t surface;     ///< its number among those asked for
  std::array<float, 6> ends; ///< their places, centred

  bool operator==(const Edge& other) const
  {
    return this->surface == other.surface && this->ends == other.ends;
  }
};

struct EdgeHash
{
  std::size_t operator()(const Edge& edge) const
  {
    std::size_t seed = edge.surface;
    for (const float coordinate : edge.ends)
    {
      hashCombine(seed, coordinate);
    }
    return seed;
  }
};

/// An edge on its way, with a triangle that names its patch in the rank that sends it.
struct SentEdge
{
  Edge edge;
  std::uint32_t triangle;
};

/// Return a point by which ranks recognise it. Sources that compute a point in several ranks round
/// zeros otherwise, so a coordinate counts to the noise of the point's largest.
std::array<float, 3> placeOf(const glm::vec3& point)
{
  const float largest = std::max({ std::abs(point.x), std::abs(point.y), std::abs(point.z) });
  const glm::vec3 rounded = (point + largest) - largest; // 0 is never negative
  return { rounded.x, rounded.y, rounded.z };
}

/// Call visit(edge, triangle) for all edges of a surface.
/// @param number of the surface
/// @param triangle counted from the surface's first
template <typename Visit>
void visitEdges(
  const Occluders& snapshot, const Surface& surface, std::uint32_t number, const Visit& visit)
{
  for (std::uint32_t triangle = 0; triangle < surface.triangleCount; ++triangle)
  {
    const glm::uvec3 corners = snapshot.triangles[surface.firstTriangle + triangle];
    for (int i = 0; i < 3; ++i)
    {
      std::array<float, 3> from = placeOf(snapshot.positionsCentred[corners[i]]);
      std::array<float, 3> to = placeOf(snapshot.positionsCentred[corners[(i + 1) % 3]]);
      if (to < from)
      {
        std::swap(from, to);
      }
      visit(Edge{ number, { from[0], from[1], from[2], to[0], to[1], to[2] } }, triangle);
    }
  }
}

/// Sets of patches that are one. The least name of a set is that of all.
class United
{
public:
  PatchName nameOf(PatchName patch) const
  {
    for (auto found = this->less_.find(patch); found != this->less_.end();
         found = this->less_.find(patch))
    {
      patch = found->second;
    }
    return patch;
  }

  /// @return false if they were one already
  bool unite(const PatchName& a, const PatchName& b)
  {
    const auto [least, other] = std::minmax({ this->nameOf(a), this->nameOf(b) });
    for (const PatchName& patch : { a, b, other }) // the first two for shorter ways
    {
      if (!(patch == least))
      {
        this->less_[patch] = least;
      }
    }
    return !(least == other);
  }

private:
  std::map<PatchName, PatchName> less_; ///< another of the same set
};

/// Gather sets, and return their union.
std::set<SharedName> united(Ranks& ranks, const std::set<SharedName>& mine)
{
  Ranks::Gathered<SharedName> all;
  ranks.gather(std::vector<SharedName>(mine.begin(), mine.end()), all);
  return { all.elements.begin(), all.elements.end() };
}

/// Return the surfaces that receivers with curves are on.
std::set<SharedName> namesOfCurved(
  const std::vector<SharedName>& names, const ReceiverPixels& receivers)
{
  std::vector<bool> hasCurves(names.size(), false);
  for (std::size_t i = 0; i < receivers.curves.size(); ++i)
  {
    if (receivers.surface[i] != ReceiverPixels::notCovered && receivers.curved[i] != 0)
    {
      hasCurves[receivers.surface[i]] = true;
    }
  }
  std::set<SharedName> curved;
  for (std::size_t surface = 0; surface < names.size(); ++surface)
  {
    if (hasCurves[surface])
    {
      curved.insert(names[surface]);
    }
  }
  return curved;
}

/// Return the patches of the surfaces that are asked for; null for others.
std::vector<std::shared_ptr<Patches>> patchesOf(const Occluders& snapshot,
  const std::vector<SharedName>& names, const std::set<SharedName>& asked)
{
  std::vector<std::shared_ptr<Patches>> patches(names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    patches[i] = asked.count(names[i]) > 0 ? snapshot.surfaces[i].patches : nullptr;
  }
  return patches;
}

} // namespace

bool SharedPatches::update(Ranks& ranks, const Occluders& snapshot,
  const std::vector<SharedName>& names, const ReceiverPixels& own)
{
  std::set<SharedName> asked = united(ranks, namesOfCurved(names, own));
  if (asked.empty())
  {
    return false;
  }
  asked.insert(this->asked_.begin(), this->asked_.end()); // other views'
  if (ranks.isAny(this->ranks_ != ranks.serial() || asked != this->asked_ ||
        patchesOf(snapshot, names, asked) != this->patches_))
  {
    this->ranks_ = 0; // in case of an error
    this->asked_ = united(ranks, asked);
    this->patches_ = patchesOf(snapshot, names, this->asked_);
    this->name(ranks, snapshot, names);
    this->ranks_ = ranks.serial();
  }
  return true;
}

/// Name the patches of patches_. Ranks send the edges that one triangle of theirs has, and one of
/// each patch, as other ranks may have all of it. Each finds these among its own edges.
void SharedPatches::name(
  Ranks& ranks, const Occluders& snapshot, const std::vector<SharedName>& names)
{
  const auto visitOwn = [&](const auto& visit)
  {
    for (std::size_t i = 0; i < this->patches_.size(); ++i)
    {
      const Surface& surface = snapshot.surfaces[i];
      if (this->patches_[i] && !surface.isInstanced()) // no other rank has parts of an instance
      {
        const std::vector<std::uint32_t>& numbers = this->patches_[i]->numbers(snapshot, surface);
        const auto number = static_cast<std::uint32_t>(
          std::distance(this->asked_.begin(), this->asked_.find(names[i])));
        visitEdges(snapshot, surface, number,
          [&](const Edge& edge, std::uint32_t triangle) {
            visit(
              edge, surface.firstTriangle + triangle, surface.firstTriangle + numbers[triangle]);
          });
      }
    }
  };
  std::unordered_map<Edge, std::uint32_t, EdgeHash> uses;
  visitOwn([&](const Edge& edge, std::uint32_t, std::uint32_t) { ++uses[edge]; });
  std::vector<SentEdge> sent;
  visitOwn(
    [&](const Edge& edge, std::uint32_t triangle, std::uint32_t patch)
    {
      if (uses[edge] == 1 || triangle == patch)
      {
        sent.push_back({ edge, patch });
      }
    });
  Ranks::Gathered<SentEdge> all;
  ranks.gather(sent, all);

  United one;
  std::unordered_map<Edge, PatchName, EdgeHash> patchAt;
  for (std::uint32_t rank = 0; rank + 1 < all.firsts.size(); ++rank)
  {
    for (std::size_t i = all.firsts[rank]; i < all.firsts[rank + 1]; ++i)
    {
      const PatchName patch{ rank, all.elements[i].triangle };
      one.unite(patchAt.try_emplace(all.elements[i].edge, patch).first->second, patch);
    }
  }
  const auto own = static_cast<std::uint32_t>(ranks.own());
  std::vector<std::array<PatchName, 2>> pairs;
  visitOwn(
    [&](const Edge& edge, std::uint32_t, std::uint32_t triangle)
    {
      const auto found = patchAt.find(edge);
      const PatchName patch{ own, triangle };
      if (found != patchAt.end() && one.unite(found->second, patch))
      {
        pairs.push_back({ found->second, patch });
      }
    });
  Ranks::Gathered<std::array<PatchName, 2>> allPairs;
  ranks.gather(pairs, allPairs);
  for (const auto& [a, b] : allPairs.elements)
  {
    one.unite(a, b);
  }

  this->names_.assign(this->patches_.size(), {});
  for (std::size_t i = 0; i < this->patches_.size(); ++i)
  {
    const Surface& surface = snapshot.surfaces[i];
    if (this->patches_[i])
    {
      const std::vector<std::uint32_t>& numbers = this->patches_[i]->numbers(snapshot, surface);
      std::transform(numbers.begin(), numbers.end(), std::back_inserter(this->names_[i]),
        [&](std::uint32_t number) {
          return one.nameOf({ own, surface.firstTriangle + number });
        });
    }
  }
}

std::size_t SharedPatches::bytes() const
{
  std::size_t bytes = bytesOf(this->names_) + bytesOf(this->patches_);
  for (const std::vector<PatchName>& names : this->names_)
  {
    bytes += bytesOf(names);
  }
  return bytes;
}

} // namespace gnomon
