#include "shadowtech/conservative/CasterSolids.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/CasterShapes.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <tbb/parallel_for.h>
#include <tbb/spin_mutex.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace gnomon
{
namespace
{

/// How far around a triangle others are looked for at most, of the size of its solid.
constexpr double reachOfSize = 1.0 / 512.0;

/// With more pairs than that for each triangle, about, they are not looked at.
constexpr std::size_t mostPairs = 64;

/// Sines and shares of a solid's size that are less say nothing: double precision is surer than that.
constexpr double smallest = 1e-10;

Bounds grown(const Bounds& box, double by)
{
  return { box.lower - by, box.upper + by };
}

/// A triangle of a solid.
struct Facet
{
  std::array<glm::dvec3, 3> corners;
  std::array<std::uint32_t, 3> vertices; ///< as they count (SurfaceEdges::welded)
  glm::dvec3 normal{ 0.0 };              ///< of unit length; none where it has no area
};

/// The solid angle that a triangle takes as a point sees it, positive from where it is wound clockwise (van Oosterom and
/// Strackee, The solid angle of a plane triangle, 1983, equation 8).
double solidAngleOf(const Facet& facet, const glm::dvec3& from)
{
  const glm::dvec3 a = facet.corners[0] - from;
  const glm::dvec3 b = facet.corners[1] - from;
  const glm::dvec3 c = facet.corners[2] - from;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2.0 *
    std::atan2(glm::dot(a, glm::cross(b, c)),
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

/// How far apart the extents of two sets of points along an axis are; negative where they overlap.
template <std::size_t A, std::size_t B>
double gapAlong(
  const glm::dvec3& axis, const std::array<glm::dvec3, A>& a, const std::array<glm::dvec3, B>& b)
{
  const double length = glm::length(axis);
  if (!(length > 0.0))
  {
    return -std::numeric_limits<double>::infinity();
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double lowA = infinity, highA = -infinity, lowB = infinity, highB = -infinity;
  for (const glm::dvec3& point : a)
  {
    const double along = glm::dot(axis, point - a[0]);
    lowA = std::min(lowA, along);
    highA = std::max(highA, along);
  }
  for (const glm::dvec3& point : b)
  {
    const double along = glm::dot(axis, point - a[0]);
    lowB = std::min(lowB, along);
    highB = std::max(highB, along);
  }
  return std::max(lowB - highA, lowA - highB) / length;
}

/// A distance that two triangles, or a triangle and a segment, have at least: the widest gap between them along the normals, the
/// cross products of their sides, and their sides' normals in their planes (separating axes; Ericson,
/// Real-Time Collision Detection, 5.2.1), up to `enough`. Not more than 0 where they meet.
template <std::size_t A, std::size_t B>
double gapBetween(const std::array<glm::dvec3, A>& a, const glm::dvec3& normalA,
  const std::array<glm::dvec3, B>& b, const glm::dvec3& normalB, double enough)
{
  double widest = std::max(gapAlong(normalA, a, b), gapAlong(normalB, a, b));
  for (std::size_t i = 0; i < A && widest < enough; ++i)
  {
    const glm::dvec3 side = a[(i + 1) % A] - a[i];
    widest = std::max(widest, gapAlong(glm::cross(normalA, side), a, b));
    for (std::size_t j = 0; j < B && widest < enough; ++j)
    {
      const glm::dvec3 otherSide = b[(j + 1) % B] - b[j];
      widest = std::max(widest, gapAlong(glm::cross(side, otherSide), a, b));
      widest = std::max(widest, gapAlong(glm::cross(normalB, otherSide), a, b));
    }
  }
  return widest;
}

/// Whether two triangles that share a corner are sure not to cross: a plane through it has all of one of them strictly on one side, and
/// the other one on the other side or in it, or of both a side in it, and the rest to either side.
/// @param a, b from the shared corner to the other two
bool meetInCorner(const std::array<glm::dvec3, 2>& a, const glm::dvec3& normalA,
  const std::array<glm::dvec3, 2>& b, const glm::dvec3& normalB)
{
  const auto separates = [&](glm::dvec3 axis)
  {
    const double length = glm::length(axis);
    // Written so that NaN fails. Of sides that are nearly one, the cross product says nothing.
    if (!(length > smallest))
    {
      return false;
    }
    axis /= length;
    const auto sideOf = [&](const glm::dvec3& of)
    {
      const double sine = glm::dot(axis, of) / glm::length(of);
      return sine > smallest ? 1 : sine < -smallest ? -1 : 0;
    };
    const int a0 = sideOf(a[0]), a1 = sideOf(a[1]), b0 = sideOf(b[0]), b1 = sideOf(b[1]);
    // Signs that do not contradict each other, and that fix a side.
    const int ofA = a0 != 0 ? a0 : a1;
    const int ofB = b0 != 0 ? b0 : b1;
    if (a0 * a1 < 0 || b0 * b1 < 0 || ofA * ofB > 0)
    {
      return false;
    }
    const bool strictlyA = a0 != 0 && a1 != 0;
    const bool strictlyB = b0 != 0 && b1 != 0;
    const bool sides = ofA != 0 && ofB != 0;
    return strictlyA || strictlyB || sides;
  };
  if (separates(normalA) || separates(normalB))
  {
    return true;
  }
  for (const glm::dvec3& sideA : a)
  {
    if (separates(glm::cross(normalA, sideA / glm::length(sideA))))
    {
      return true;
    }
    for (const glm::dvec3& sideB : b)
    {
      if (separates(glm::cross(sideA / glm::length(sideA), sideB / glm::length(sideB))) ||
        separates(glm::cross(normalB, sideB / glm::length(sideB))))
      {
        return true;
      }
    }
  }
  return false;
}

/// Looks at all pairs of triangles of a surface's solids that are near each other, and at which side of them is outside.
class SolidSearch
{
public:
  /// @param leastReach of solids that are of use
  SolidSearch(const Occluders& occluders, const Surface& surface, const SurfaceEdges& edges,
    double leastReach, MeetingBoxes& meeting, SurfaceSolids& found)
    : surface_(surface)
    , edges_(edges)
    , found_(found)
  {
    this->facets_.resize(surface.triangleCount);
    tbb::parallel_for(std::uint32_t(0), surface.triangleCount,
      [&](std::uint32_t i)
      {
        Facet& facet = this->facets_[i];
        const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + i];
        for (int k = 0; k < 3; ++k)
        {
          facet.corners[static_cast<std::size_t>(k)] = occluders.positionsCentred[corners[k]];
          facet.vertices[static_cast<std::size_t>(k)] =
            edges.welded[corners[k] - surface.firstVertex];
        }
        const auto& [a, b, c] = facet.corners;
        const glm::dvec3 area = glm::cross(b - a, c - a);
        const double length = glm::length(area);
        facet.normal = length > 0.0 ? area / length : glm::dvec3(0.0);
      });
    this->measure(leastReach);
    this->lookAtPairs(meeting);
    this->findOutside();
  }

private:
  /// Sizes, and as much clearance as is looked for.
  void measure(double leastReach)
  {
    SurfaceSolids& found = this->found_;
    this->crosses_.assign(this->facets_.size(), 0);
    this->ofSolid_.resize(found.solids.size());
    for (std::uint32_t i = 0; i < this->facets_.size(); ++i)
    {
      if (found.ofTriangle[i] != SurfaceSolids::none)
      {
        this->ofSolid_[found.ofTriangle[i]].push_back(i);
      }
    }
    for (std::size_t i = 0; i < found.solids.size(); ++i)
    {
      SurfaceSolids::Solid& solid = found.solids[i];
      for (const std::uint32_t facet : this->ofSolid_[i])
      {
        solid.boxCentred.add(this->boxOf(facet));
      }
      const double reach = this->reachAround(solid, this->ofSolid_[i]);
      if (reach < leastReach)
      {
        found.largestLeftOut = std::max(found.largestLeftOut, reach);
      }
      else if (this->countClose(this->ofSolid_[i], reach) <= mostPairs * this->ofSolid_[i].size())
      {
        solid.reach = reach;
      }
      for (const std::uint32_t facet : this->ofSolid_[i])
      {
        found.clearance[facet] = static_cast<float>(solid.reach);
      }
    }
  }

  Bounds boxOf(std::uint32_t facet) const
  {
    Bounds box;
    for (const glm::dvec3& corner : this->facets_[facet].corners)
    {
      box.add(corner);
    }
    return box;
  }

  /// No more than its triangles are long, but for a tenth of them: else fine meshes would have too many near each other.
  double reachAround(
    const SurfaceSolids::Solid& solid, const std::vector<std::uint32_t>& facets) const
  {
    std::vector<double> lengths;
    lengths.reserve(facets.size());
    for (const std::uint32_t facet : facets)
    {
      const auto& [a, b, c] = this->facets_[facet].corners;
      lengths.push_back(std::max({ glm::length(b - a), glm::length(c - b), glm::length(a - c) }));
    }
    const auto tenth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 10);
    std::nth_element(lengths.begin(), tenth, lengths.end());
    return std::min(2.0 * reachOfSize * solid.boxCentred.radius(), *tenth);
  }

  /// How many pairs of triangles begin in one cell of a grid.
  std::size_t countClose(const std::vector<std::uint32_t>& facets, double cell) const
  {
    std::vector<std::array<std::int64_t, 3>> cells;
    cells.reserve(facets.size());
    for (const std::uint32_t facet : facets)
    {
      const glm::dvec3 place = glm::floor(this->facets_[facet].corners[0] / cell);
      cells.push_back({ { static_cast<std::int64_t>(place.x), static_cast<std::int64_t>(place.y),
        static_cast<std::int64_t>(place.z) } });
    }
    std::sort(cells.begin(), cells.end());
    std::size_t pairs = 0;
    for (auto first = cells.begin(); first != cells.end();)
    {
      const auto last = std::upper_bound(first, cells.end(), *first);
      const auto count = static_cast<std::size_t>(last - first);
      pairs += count * count;
      first = last;
    }
    return pairs;
  }

  /// The pairs whose boxes meet, grown by half of what is looked for.
  void lookAtPairs(MeetingBoxes& meeting)
  {
    std::vector<Bounds> boxes;
    std::vector<std::uint32_t> ofBox;
    for (std::size_t solid = 0; solid < this->ofSolid_.size(); ++solid)
    {
      const double reach = this->found_.solids[solid].reach;
      for (const std::uint32_t facet : this->ofSolid_[solid])
      {
        if (reach > 0.0)
        {
          boxes.push_back(grown(this->boxOf(facet), 0.51 * reach)); // a little more, for rounding
          ofBox.push_back(facet);
        }
      }
    }
    meeting.visit(boxes,
      [&](std::uint32_t a, std::uint32_t b)
      {
        if (this->found_.ofTriangle[ofBox[a]] == this->found_.ofTriangle[ofBox[b]])
        {
          this->lookAt(ofBox[a], ofBox[b]);
        }
      });
  }

  /// Two triangles of a solid.
  void lookAt(std::uint32_t first, std::uint32_t second)
  {
    const Facet& a = this->facets_[first];
    const Facet& b = this->facets_[second];
    // Written so that a triangle without a normal is never alike.
    const double cosine = glm::dot(a.normal, b.normal);
    const bool alike = cosine >= sharpCosine;
    std::array<std::size_t, 3> ofA, ofB; // which corners they share
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        if (a.vertices[i] == b.vertices[j] && shared < 3)
        {
          ofA[shared] = i;
          ofB[shared++] = j;
        }
      }
    }
    const SurfaceSolids::Solid& solid = this->found_.solids[this->found_.ofTriangle[first]];
    if (shared == 0)
    {
      const double none = smallest * solid.boxCentred.radius();
      const double gap =
        gapBetween(a.corners, a.normal, b.corners, b.normal, alike ? 2.0 * none : solid.reach);
      if (!(gap > none))
      {
        this->noteCrossing(first, second);
      }
      else if (!alike)
      {
        this->limit(first, gap);
        this->limit(second, gap);
      }
    }
    else if (shared == 1)
    {
      this->lookAtCorner(first, ofA[0], second, ofB[0], alike);
    }
    else if (shared == 2 && cosine > -1.0 + smallest)
    {
      if (!alike && !bulges(a, b))
      {
        this->limit(first, 0.0);
        this->limit(second, 0.0);
      }
    }
    else
    {
      this->noteCrossing(first, second); // folded onto each other, or the same twice
    }
  }

  /// Two triangles that share one corner.
  void lookAtCorner(std::uint32_t first, std::size_t cornerOfFirst, std::uint32_t second,
    std::size_t cornerOfSecond, bool alike)
  {
    const Facet& a = this->facets_[first];
    const Facet& b = this->facets_[second];
    const auto othersOf = [](const Facet& facet, std::size_t corner)
    {
      return std::array<glm::dvec3, 2>{ { facet.corners[(corner + 1) % 3],
        facet.corners[(corner + 2) % 3] } };
    };
    const std::array<glm::dvec3, 2> farA = othersOf(a, cornerOfFirst);
    const std::array<glm::dvec3, 2> farB = othersOf(b, cornerOfSecond);
    const glm::dvec3& corner = a.corners[cornerOfFirst];
    if (!meetInCorner({ { farA[0] - corner, farA[1] - corner } }, a.normal,
          { { farB[0] - corner, farB[1] - corner } }, b.normal))
    {
      this->noteCrossing(first, second);
    }
    else if (!alike)
    {
      // A walk from one to the other either passes one of the corner's edges, which are sharp, or the far side.
      const bool bulge = bulges(a, b);
      const double reach = this->found_.solids[this->found_.ofTriangle[first]].reach;
      const glm::dvec3 none(0.0);
      this->limit(first, bulge ? gapBetween(a.corners, a.normal, farB, none, reach) : 0.0);
      this->limit(second, bulge ? gapBetween(b.corners, b.normal, farA, none, reach) : 0.0);
    }
  }

  /// Whether each of two triangles with common corners lies behind the other's plane, or in it.
  static bool bulges(const Facet& a, const Facet& b)
  {
    const auto isBehind = [](const Facet& facet, const Facet& of)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const bool common =
          std::find(of.vertices.begin(), of.vertices.end(), facet.vertices[i]) != of.vertices.end();
        if (!common && !(glm::dot(of.normal, facet.corners[i] - of.corners[0]) <= 0.0))
        {
          return false;
        }
      }
      return true;
    };
    const bool haveNormals = a.normal != glm::dvec3(0.0) && b.normal != glm::dvec3(0.0);
    return haveNormals && isBehind(a, b) && isBehind(b, a);
  }

  void limit(std::uint32_t facet, double clearance)
  {
    const tbb::spin_mutex::scoped_lock lock(this->mutex_);
    float& of = this->found_.clearance[facet];
    of = std::min(of, static_cast<float>(std::max(clearance, 0.0)));
  }

  /// That two triangles meet where they should not, or are not sure not to.
  void noteCrossing(std::uint32_t first, std::uint32_t second)
  {
    this->limit(first, 0.0);
    this->limit(second, 0.0);
    const tbb::spin_mutex::scoped_lock lock(this->mutex_);
    this->crosses_[first] = this->crosses_[second] = 1;
  }

  /// Leaves triangles on whose outer side is what is outside of the solid as a whole: of all that hangs together without crossing anything, it is
  /// the same. Pieces of less than an eighth of a solid are left out.
  void findOutside()
  {
    std::vector<std::uint8_t> seen(this->facets_.size(), 0);
    for (std::uint32_t solid = 0; solid < this->ofSolid_.size(); ++solid)
    {
      for (const std::uint32_t first : this->ofSolid_[solid])
      {
        if (this->found_.solids[solid].reach == 0.0 || this->crosses_[first] || seen[first])
        {
          continue;
        }
        const std::vector<std::uint32_t> piece = this->pieceAround(first, seen);
        const bool isLarge = 8 * piece.size() >= this->ofSolid_[solid].size();
        const bool isOuter = isLarge && this->isOuter(piece, this->ofSolid_[solid]);
        for (const std::uint32_t facet : piece)
        {
          this->found_.clearance[facet] = isOuter ? this->found_.clearance[facet] : 0.0f;
          this->found_.solids[solid].clearCount += this->found_.clearance[facet] > 0.0f ? 1 : 0;
        }
      }
    }
  }

  std::vector<std::uint32_t> pieceAround(std::uint32_t first, std::vector<std::uint8_t>& seen) const
  {
    std::vector<std::uint32_t> piece{ first };
    seen[first] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      for (const std::uint32_t edge : this->edges_.ofTriangle[piece[i]])
      {
        const std::uint32_t triangle = this->surface_.firstTriangle + piece[i];
        const std::uint32_t next =
          this->edges_.edges[edge].other(triangle) - this->surface_.firstTriangle;
        if (!this->crosses_[next] && !seen[next])
        {
          seen[next] = 1;
          piece.push_back(next);
        }
      }
    }
    return piece;
  }

  /// Whether the solid winds around no point where a piece's triangles are seen counter-clockwise, and once around those on the other side.
  ///
  /// As seen from a point, all triangles take 4 pi times as much as they wind around it. From a point of one of them that takes nothing itself, and the
  /// others take the mean of both sides: 2 pi (0 + 1).
  bool isOuter(
    const std::vector<std::uint32_t>& piece, const std::vector<std::uint32_t>& solid) const
  {
    const std::uint32_t from = *std::max_element(piece.begin(), piece.end(),
      [this](std::uint32_t a, std::uint32_t b)
      { return this->found_.clearance[a] < this->found_.clearance[b]; });
    if (!(this->found_.clearance[from] > 0.0f))
    {
      return false;
    }
    const auto& [a, b, c] = this->facets_[from].corners;
    const glm::dvec3 middle = (a + b + c) / 3.0;
    double angle = 0.0;
    for (const std::uint32_t facet : solid)
    {
      angle += facet == from ? 0.0 : solidAngleOf(this->facets_[facet], middle);
    }
    return std::abs(angle - glm::two_pi<double>()) < 1.0; // not NaN
  }

  const Surface& surface_;
  const SurfaceEdges& edges_;
  SurfaceSolids& found_;
  std::vector<Facet> facets_;
  std::vector<std::vector<std::uint32_t>> ofSolid_; ///< triangles, by solid
  std::vector<std::uint8_t> crosses_; ///< by triangle, whether it meets another where it should not
  tbb::spin_mutex mutex_;
};

/// Of one-sided ones rays do not see how they are entered, through cut-out ones they pass, and instances may be anywhere.
bool mayHaveSolids(const Surface& surface)
{
  return !surface.oneSided && !surface.cutout && !surface.isInstanced();
}

/// Finds the solids of a surface that may have some, and how clear their triangles are.
/// @param parts CasterEdges::partOf() by triangles of the snapshot
SurfaceSolids findSolids(const Occluders& occluders, const Surface& surface,
  const SurfaceEdges& edges, const std::vector<std::uint32_t>& parts, MeetingBoxes& meeting)
{
  SurfaceSolids found;
  const auto partOf = [&](std::uint32_t triangle)
  { return parts[surface.firstTriangle + triangle] - surface.firstTriangle; };
  // A part that goes on as another surface ends in this one, and its least triangle may be of that other.
  std::vector<std::uint8_t> isOpen(surface.triangleCount, 0);
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    for (const std::uint32_t number : edges.ofTriangle[i])
    {
      const CasterEdge& edge = edges.edges[number];
      if ((edge.triangles[1] == CasterEdge::none || edge.sameDirection) &&
        partOf(i) < surface.triangleCount)
      {
        isOpen[partOf(i)] = 1;
      }
    }
  }
  std::vector<std::uint32_t> solids(surface.triangleCount, SurfaceSolids::none);
  std::vector<std::uint32_t> ofTriangle(surface.triangleCount, SurfaceSolids::none);
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    if (partOf(i) >= surface.triangleCount || isOpen[partOf(i)] != 0)
    {
      continue;
    }
    std::uint32_t& solid = solids[partOf(i)];
    if (solid == SurfaceSolids::none)
    {
      solid = static_cast<std::uint32_t>(found.solids.size());
      found.solids.emplace_back();
    }
    ofTriangle[i] = solid;
  }
  if (!found.solids.empty())
  {
    found.ofTriangle = std::move(ofTriangle);
    found.clearance.assign(surface.triangleCount, 0.0f);
    SolidSearch(occluders, surface, edges, leastClearance(occluders), meeting, found);
  }
  return found;
}

} // namespace

//------------------------------------------------------------------------------
std::size_t SurfaceSolids::bytes() const
{
  return bytesOf(this->solids) + bytesOf(this->ofTriangle) + bytesOf(this->clearance);
}

//------------------------------------------------------------------------------
void CasterSolids::update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges,
  const std::vector<std::uint32_t>& parts)
{
  const auto find = [&](const Occluders& from, const Surface& surface, SurfaceSolids& found)
  {
    const bool mayHaveSome = mayHaveSolids(surface);
    if (!found.areFound || found.mayHaveSome != mayHaveSome ||
      found.largestLeftOut >= leastClearance(from))
    {
      const auto index = static_cast<std::size_t>(&surface - from.surfaces.data());
      found = mayHaveSome ? findSolids(from, surface, *edges[index], parts, this->meeting_)
                          : SurfaceSolids();
      found.areFound = true;
      found.positionsVersion = surface.positionsVersion;
      found.mayHaveSome = mayHaveSome;
    }
  };
  this->kept_.update(
    occluders,
    [&](const Occluders& from, const Surface& surface, SurfaceSolids& found)
    {
      const bool isNew = found.positionsVersion == 0;
      if (isNew || found.positionsVersion == surface.positionsVersion)
      {
        find(from, surface, found);
        return;
      }
      found = SurfaceSolids();
      found.positionsVersion = surface.positionsVersion;
    },
    find);
  this->keepApart(occluders);
}

//------------------------------------------------------------------------------
/// Leaves solids whose boxes do not meet, and of those that do, the ones with the most triangles that are clear.
void CasterSolids::keepApart(const Occluders& occluders)
{
  static const SurfaceSolids none;
  const auto foundOf = [&](std::size_t surface) -> const SurfaceSolids&
  { return occluders.surfaces[surface].casts ? this->kept_.of(surface) : none; };
  bool areAllFound = true;
  const double leastReach = leastClearance(occluders);
  std::vector<Bounds> boxes;
  std::vector<std::uint32_t> clearCounts;
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    areAllFound &= !occluders.surfaces[i].casts || foundOf(i).areFound;
    for (const SurfaceSolids::Solid& solid : foundOf(i).solids)
    {
      boxes.push_back(grown(solid.boxCentred, solid.reach));
      // Where the scene has grown, what is too small to be of use is in nobody's way.
      clearCounts.push_back(solid.reach >= leastReach ? solid.clearCount : 0);
    }
  }
  const auto isLarger = [&](std::uint32_t a, std::uint32_t b)
  { return std::tie(clearCounts[a], b) > std::tie(clearCounts[b], a); };
  std::vector<std::vector<std::uint32_t>> larger(boxes.size()); // of those that a box meets
  tbb::spin_mutex mutex;
  this->meeting_.visit(boxes,
    [&](std::uint32_t a, std::uint32_t b)
    {
      const tbb::spin_mutex::scoped_lock lock(mutex);
      isLarger(a, b) ? larger[b].push_back(a) : larger[a].push_back(b);
    });
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), isLarger);
  std::vector<std::uint8_t> stays(boxes.size(), 1);
  for (const std::uint32_t solid : order)
  {
    stays[solid] = clearCounts[solid] > 0 &&
      std::none_of(larger[solid].begin(), larger[solid].end(),
        [&](std::uint32_t other) { return stays[other] != 0; });
  }
  this->clearance_.assign(occluders.triangles.size(), 0.0f);
  std::uint32_t first = 0;
  for (std::size_t surface = 0; surface < occluders.surfaces.size(); ++surface)
  {
    const SurfaceSolids& found = foundOf(surface);
    for (std::size_t i = 0; i < found.ofTriangle.size(); ++i)
    {
      const std::uint32_t solid = first + found.ofTriangle[i];
      if (found.ofTriangle[i] != SurfaceSolids::none && stays[solid] != 0)
      {
        this->clearance_[occluders.surfaces[surface].firstTriangle + i] = found.clearance[i];
      }
    }
    first += static_cast<std::uint32_t>(found.solids.size());
  }
  this->areAllFound_ = areAllFound; // at last: where Embree fails, another update is to try again
}

//------------------------------------------------------------------------------
std::size_t CasterSolids::bytes() const
{
  return this->kept_.bytes() + bytesOf(this->clearance_);
}

} // namespace gnomon
