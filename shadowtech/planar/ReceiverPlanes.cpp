#include "shadowtech/planar/ReceiverPlanes.h"

#include "shadowtech/base/Occluders.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon
{
namespace
{

/// How far from their common plane the corners of coplanar triangles lie, as a share of
/// sum |n_i| |p_i|: rounding moves a corner by up to one unit roundoff 2^-24 of that, the plane, which is
/// found from such corners, by about as much again, and half of it is left over.
constexpr double cornerNoise = 4.0 / (1 << 24);
/// What evaluating n.p + d in float adds: four products and sums of a rounded plane and a rounded point.
constexpr double evaluationNoise = 8.0 / (1 << 24);

/// A plane near the border of cells may be spread over so many of them.
constexpr double splitShare = 1.0 / 8.0;

/// Sums up triangles that lie on one plane. Their area vectors add up to that of their common outline,
/// so that the errors of small triangles do not.
struct PlaneSum
{
  glm::dvec3 areaVector{ 0.0 };
  glm::dvec3 moment{ 0.0 };
  double area = 0.0;

  void add(const ReceivingTriangle& triangle, const glm::dvec3& along)
  {
    const double weight = triangle.area();
    const double side = glm::dot(triangle.areaVector, along) < 0.0 ? -1.0 : 1.0;
    this->areaVector += side * triangle.areaVector;
    this->moment += weight * triangle.centroid();
    this->area += weight;
  }
  void add(const PlaneSum& other)
  {
    this->areaVector += other.areaVector;
    this->moment += other.moment;
    this->area += other.area;
  }
  glm::dvec4 plane() const
  {
    const glm::dvec3 normal = glm::normalize(this->areaVector);
    return { normal, -glm::dot(normal, this->moment) / this->area };
  }
};

double distanceOff(const glm::dvec4& plane, const glm::dvec3& point)
{
  return std::abs(glm::dot(plane, glm::dvec4(point, 1.0)));
}

/// sum |n_i| |p_i|, which bounds the rounding of n.p.
double magnitudeAlong(const glm::dvec4& plane, const glm::dvec3& point)
{
  return glm::dot(glm::abs(glm::dvec3(plane)), glm::abs(point));
}

/// Whether no corner in a box lies as near to a plane as coplanar triangles' corners do.
bool liesOff(const TriangleBox& box, const glm::dvec4& plane)
{
  const glm::dvec3 lower = box.lower;
  const glm::dvec3 upper = box.upper;
  const double extent = glm::dot(glm::abs(glm::dvec3(plane)), 0.5 * (upper - lower));
  const glm::dvec3 largest = glm::max(glm::abs(lower), glm::abs(upper));
  return distanceOff(plane, 0.5 * (lower + upper)) - extent >
    cornerNoise * magnitudeAlong(plane, largest);
}

/// Searches a snapshot for planes.
class PlaneSearch
{
public:
  PlaneSearch(const Occluders& occluders, const TriangleCells& cells, std::size_t wanted)
    : occluders_(occluders)
    , cells_(cells)
    , wanted_(wanted)
    , leastArea_(ReceiverPlanes::smallestShare * cells.area())
    , planeOfTriangle_(occluders.triangles.size(), 0)
  {
  }

  /// By triangle of the snapshot: 0, or 1 + its plane.
  const std::vector<std::uint8_t>& planeOfTriangle() const { return this->planeOfTriangle_; }

  std::vector<ReceiverPlane> run()
  {
    this->collectCandidates();
    std::vector<ReceiverPlane> planes;
    // Candidates fail where surfaces are almost flat. More of them than this are not worth the time.
    int tries = 2 * mostPlanes;
    std::size_t before = 0;
    do
    {
      before = planes.size();
      for (const Candidate* candidate : this->largestCandidates())
      {
        if (planes.size() == mostPlanes || tries-- <= 0 || this->hasLargerThan(*candidate, planes))
        {
          break;
        }
        if (this->planeOfTriangle_[candidate->largest] == 0)
        {
          this->grow(*candidate, planes);
        }
      }
      // What was like a plane that has been found may be another one.
    } while (planes.size() > before && planes.size() < mostPlanes);
    this->sortByArea(planes);
    return planes;
  }

private:
  /// A cell with enough area, from which a plane may be grown.
  struct Candidate
  {
    struct Part
    {
      const TriangleCells::PlacedBlock* block;
      const TriangleBlock::Cell* cell;
    };
    std::vector<Part> parts;
    // Of its triangles that lie on no plane yet:
    std::size_t count = 0;
    double area = 0.0;
    double largestArea = 0.0;
    std::size_t largest = 0; ///< the triangle
  };

  /// What a block has on a plane.
  struct Share
  {
    std::vector<std::size_t> members;
    double area = 0.0;
    double farthestOff = 0.0; ///< of its corners from the plane
    double magnitude = 0.0;   ///< magnitudeAlong()
    Bounds boundsCentred;
  };

  /// Calls visit(number) for those of a part's triangles that lie on no plane yet.
  template <typename Visit>
  void visitFree(const Candidate::Part& part, const Visit& visit) const
  {
    for (std::uint32_t i = part.cell->begin; i < part.cell->end; ++i)
    {
      const std::size_t number = part.block->first() + part.block->block->triangles()[i];
      if (this->planeOfTriangle_[number] == 0)
      {
        visit(number);
      }
    }
  }

  /// The cells that hold enough, of all blocks together.
  void collectCandidates()
  {
    std::vector<Candidate::Part> parts;
    for (const TriangleCells::PlacedBlock& placed : this->cells_.blocks())
    {
      for (const TriangleBlock::Cell& cell : placed.block->cells())
      {
        parts.push_back({ &placed, &cell });
      }
    }
    std::stable_sort(parts.begin(), parts.end(),
      [](const auto& a, const auto& b) { return a.cell->key < b.cell->key; });
    for (auto begin = parts.begin(); begin != parts.end();)
    {
      Candidate candidate;
      auto end = begin;
      for (; end != parts.end() && end->cell->key == begin->cell->key; ++end)
      {
        candidate.count += end->cell->end - end->cell->begin;
        candidate.area += end->cell->area;
        if (end->cell->largestArea > candidate.largestArea)
        {
          candidate.largestArea = end->cell->largestArea;
          candidate.largest = end->block->first() + end->cell->largest;
        }
      }
      if (candidate.area >= splitShare * this->leastArea_)
      {
        candidate.parts.assign(begin, end);
        this->candidates_.push_back(std::move(candidate));
      }
      begin = end;
    }
  }

  /// Counts again what lies on no plane yet, if that has changed.
  void refresh(Candidate& candidate) const
  {
    std::size_t count = 0;
    for (const auto& part : candidate.parts)
    {
      this->visitFree(part, [&](std::size_t) { ++count; });
    }
    if (count == candidate.count)
    {
      return;
    }
    candidate.count = count;
    candidate.area = candidate.largestArea = 0.0;
    for (const auto& part : candidate.parts)
    {
      this->visitFree(part,
        [&](std::size_t number)
        {
          const double area = ReceivingTriangle(this->occluders_, number).area();
          candidate.area += area;
          if (area > candidate.largestArea)
          {
            candidate.largestArea = area;
            candidate.largest = number;
          }
        });
    }
  }

  /// Those that still hold enough, in order of their area.
  std::vector<const Candidate*> largestCandidates()
  {
    tbb::parallel_for(std::size_t(0), this->candidates_.size(),
      [&](std::size_t i) { this->refresh(this->candidates_[i]); });
    std::vector<const Candidate*> result;
    for (const Candidate& candidate : this->candidates_)
    {
      if (candidate.area >= splitShare * this->leastArea_)
      {
        result.push_back(&candidate);
      }
    }
    std::sort(result.begin(), result.end(),
      [](const Candidate* a, const Candidate* b)
      { return a->area != b->area ? a->area > b->area : a->largest < b->largest; });
    return result;
  }

  /// Whether as many planes as wanted are larger than any that a candidate could be a part of.
  bool hasLargerThan(const Candidate& candidate, const std::vector<ReceiverPlane>& planes) const
  {
    const auto larger = std::count_if(planes.begin(), planes.end(),
      [&](const ReceiverPlane& plane) { return plane.area * splitShare > candidate.area; });
    return static_cast<std::size_t>(larger) >= this->wanted_;
  }

  /// Finds the plane of a candidate's largest triangle, by what else of the candidate lies on it.
  void grow(const Candidate& candidate, std::vector<ReceiverPlane>& planes)
  {
    const ReceivingTriangle seed(this->occluders_, candidate.largest);
    PlaneSum one;
    one.add(seed, seed.areaVector);
    const glm::dvec4 seedPlane = one.plane();
    // Of a small triangle the corners' rounding turns the plane: the farther away, the farther off.
    const double height = seed.height();
    const glm::dvec3 middle = seed.centroid();
    std::vector<PlaneSum> sums(candidate.parts.size());
    tbb::parallel_for(std::size_t(0), sums.size(),
      [&](std::size_t i)
      {
        this->visitFree(candidate.parts[i],
          [&](std::size_t number)
          {
            const ReceivingTriangle triangle(this->occluders_, number);
            const auto near = [&](const glm::dvec3& corner)
            {
              const double noise =
                cornerNoise * magnitudeAlong(seedPlane, glm::max(glm::abs(corner), seed.largest()));
              return distanceOff(seedPlane, corner) <=
                noise * (1.0 + glm::distance(corner, middle) / height);
            };
            if (std::all_of(triangle.corners.begin(), triangle.corners.end(), near))
            {
              sums[i].add(triangle, seed.areaVector);
            }
          });
      });
    PlaneSum sum;
    for (const PlaneSum& part : sums)
    {
      sum.add(part);
    }
    if (sum.area >= splitShare * this->leastArea_)
    {
      this->gather(sum.plane(), planes);
    }
  }

  /// Makes a plane of all that lies on it, if that is enough.
  void gather(const glm::dvec4& plane, std::vector<ReceiverPlane>& planes)
  {
    // How wide a triangle can be that lies on the plane, by its direction.
    const Bounds& all = this->occluders_.allCentred;
    const double span =
      2.0 * cornerNoise * magnitudeAlong(plane, glm::max(glm::abs(all.lower), glm::abs(all.upper)));
    std::vector<double> mostHeights(TriangleCells::directionCount, 0.0);
    for (int i = 0; i < TriangleCells::directionCount; ++i)
    {
      if (this->cells_.isWanted()[static_cast<std::size_t>(i)])
      {
        const double sine = TriangleCells::leastSine(glm::dvec3(plane), i);
        mostHeights[static_cast<std::size_t>(i)] =
          sine > 0.0 ? span / sine : std::numeric_limits<double>::infinity();
      }
    }
    std::vector<Share> shares(this->cells_.blocks().size());
    tbb::parallel_for(std::size_t(0), shares.size(),
      [&](std::size_t i)
      { shares[i] = this->shareOn(plane, mostHeights, this->cells_.blocks()[i]); });
    ReceiverPlane found;
    found.plane = plane;
    double farthestOff = 0.0;
    double magnitude = std::abs(plane.w);
    for (const Share& share : shares)
    {
      found.area += share.area;
      found.boundsCentred.add(share.boundsCentred);
      farthestOff = std::max(farthestOff, share.farthestOff);
      magnitude = std::max(magnitude, share.magnitude);
    }
    if (found.area < this->leastArea_ || found.area == 0.0)
    {
      return;
    }
    found.thickness = farthestOff + evaluationNoise * magnitude;
    planes.push_back(found);
    for (const Share& share : shares)
    {
      for (const std::size_t number : share.members)
      {
        this->planeOfTriangle_[number] = static_cast<std::uint8_t>(planes.size());
      }
    }
  }

  /// @param mostHeights by direction: the largest height of a triangle that could lie on the plane
  Share shareOn(const glm::dvec4& plane, const std::vector<double>& mostHeights,
    const TriangleCells::PlacedBlock& placed) const
  {
    Share share;
    const TriangleBlock& block = *placed.block;
    for (const TriangleBlock::Direction& direction : block.directions())
    {
      if (direction.leastHeight > mostHeights[static_cast<std::size_t>(direction.number)])
      {
        continue;
      }
      std::uint32_t box = direction.firstBox;
      for (std::uint32_t begin = direction.begin; begin < direction.end;
           begin += TriangleBlock::trianglesPerBox, ++box)
      {
        if (liesOff(block.boxes()[box], plane))
        {
          continue;
        }
        const std::uint32_t end = std::min(begin + TriangleBlock::trianglesPerBox, direction.end);
        for (std::uint32_t i = begin; i < end; ++i)
        {
          this->addIfOn(plane, placed.first() + block.triangles()[i], share);
        }
      }
    }
    return share;
  }

  /// Adds a triangle that lies on a plane, and on no other yet.
  void addIfOn(const glm::dvec4& plane, std::size_t number, Share& share) const
  {
    if (this->planeOfTriangle_[number] != 0)
    {
      return;
    }
    const ReceivingTriangle triangle(this->occluders_, number);
    const glm::dvec3 largest = triangle.largest();
    const auto on = [&](const glm::dvec3& corner)
    { return distanceOff(plane, corner) <= cornerNoise * magnitudeAlong(plane, largest); };
    if (std::all_of(triangle.corners.begin(), triangle.corners.end(), on))
    {
      share.members.push_back(number);
      share.area += triangle.area();
      share.magnitude = std::max(share.magnitude, magnitudeAlong(plane, largest));
      for (const glm::dvec3& corner : triangle.corners)
      {
        share.farthestOff = std::max(share.farthestOff, distanceOff(plane, corner));
        share.boundsCentred.add(corner);
      }
    }
  }

  /// Puts the wanted planes in order of area, and forgets the others.
  void sortByArea(std::vector<ReceiverPlane>& planes)
  {
    std::vector<std::size_t> order(planes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return planes[a].area > planes[b].area; });
    std::vector<ReceiverPlane> sorted;
    std::array<std::uint8_t, mostPlanes + 1> place{};
    for (const std::size_t number : order)
    {
      if (sorted.size() < this->wanted_)
      {
        sorted.push_back(planes[number]);
        place[number + 1] = static_cast<std::uint8_t>(sorted.size());
      }
    }
    planes = std::move(sorted);
    for (std::uint8_t& plane : this->planeOfTriangle_)
    {
      plane = place[plane];
    }
  }

  const Occluders& occluders_;
  const TriangleCells& cells_;
  std::size_t wanted_;
  double leastArea_; ///< of a plane
  std::vector<Candidate> candidates_;
  std::vector<std::uint8_t> planeOfTriangle_;
};

} // namespace

//------------------------------------------------------------------------------
void ReceiverPlanes::update(const Occluders& occluders, std::size_t wanted)
{
  if (this->version_ > 0 && this->wanted_ == wanted &&
    this->topologyVersion_ == occluders.topologyVersion &&
    this->positionsVersion_ == occluders.positionsVersion)
  {
    return;
  }
  this->cells_.update(occluders, splitShare * smallestShare);
  PlaneSearch search(occluders, this->cells_, wanted);
  this->planes_ = search.run();
  this->planeOfDrawn_.clear();
  this->drawnBegin_.clear();
  for (const Surface& surface : occluders.surfaces)
  {
    this->drawnBegin_.push_back(this->planeOfDrawn_.size());
    const std::uint8_t* planes = search.planeOfTriangle().data() + surface.firstTriangle;
    if (surface.triangleOfDrawn.empty())
    {
      this->planeOfDrawn_.insert(this->planeOfDrawn_.end(), planes, planes + surface.triangleCount);
    }
    for (const std::uint32_t triangle : surface.triangleOfDrawn)
    {
      this->planeOfDrawn_.push_back(triangle < surface.triangleCount ? planes[triangle] : 0);
    }
  }
  ++this->version_;
  this->wanted_ = wanted;
  this->topologyVersion_ = occluders.topologyVersion;
  this->positionsVersion_ = occluders.positionsVersion;
}

} // namespace gnomon
