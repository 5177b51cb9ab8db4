#pragma once

#include "lights/Bounds.h"
#include "lights/ShadowSettings.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace gnomon
{

struct Occluders;

/// The largest number of planes that a setting may ask for.
constexpr int mostPlanes = PlanarSettings::mostPlanes;

/// A plane on which receiving triangles lie, in centred coordinates.
struct ReceiverPlane
{
  glm::dvec4 plane{ 0.0 }; ///< (n, d) with n.p + d = 0 and n of unit length
  /// The distance beyond which a point is certainly off the plane, in float arithmetic. It exceeds
  /// the distance of its own triangles' corners, and the rounding of n.p + d.
  double thickness = 0.0;
  double area = 0.0; ///< of its triangles
  Bounds boundsCentred;
};

/// The flat parts of receivers: the largest planes on which triangles of the snapshot lie, across
/// all surfaces.
///
/// Triangles lie on one plane if their corners do, up to rounding to float. A plane counts if its
/// triangles have at least `smallestShare` of all receivers' area. So planes follow from the scene
/// alone, and stay the same when the camera moves. Instances lie on no plane, as many small shapes
/// have no large one.
class ReceiverPlanes
{
public:
  static constexpr double smallestShare = 1.0 / 1024.0;

  /// Find the planes, if the snapshot or `wanted` changed.
  /// @param wanted number of largest planes, at most mostPlanes
  void update(const Occluders& occluders, std::size_t wanted)
  {
    if (this->wanted_ == wanted && this->versions_ == occluders.versions())
    {
      return;
    }
    PlaneSearch search(occluders, wanted);
    this->planes_ = search.run();
    this->area_ = search.area();
    this->planeOfTriangle_ = search.planeOfTriangle();
    this->wanted_ = wanted;
    this->versions_ = occluders.versions();
  }

  /// Return the planes, the largest first; at most as many as wanted.
  const std::vector<ReceiverPlane>& planes() const { return this->planes_; }
  double area() const { return this->area_; }

  /// Return for each triangle of the snapshot 0, or 1 + its plane.
  const std::vector<std::uint8_t>& planeOfTriangle() const { return this->planeOfTriangle_; }

private:
  /// Bounds the distance of coplanar triangles' corners from their common plane, as a share of sum
  /// |n_i| |p_i|. Rounding moves a corner by up to one unit roundoff, 2^-24, of that. The plane is
  /// found from such corners, and is off by about as much. The other half is a reserve.
  static constexpr double cornerNoise = 4.0 / (1 << 24);

  /// Bounds rounding of n.p + d in float: four products and sums of a rounded plane and a rounded
  /// point.
  static constexpr double evaluationNoise = 8.0 / (1 << 24);

  /// A receiving triangle of the snapshot.
  struct Triangle
  {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 areaVector; ///< normal, as long as the area

    Triangle(const Occluders& occluders, std::size_t number)
    {
      const glm::uvec3& numbers = occluders.triangles[number];
      this->corners = { occluders.positionsCentred[numbers.x],
        occluders.positionsCentred[numbers.y], occluders.positionsCentred[numbers.z] };
      this->areaVector =
        0.5 * glm::cross(this->corners[1] - this->corners[0], this->corners[2] - this->corners[0]);
    }
    double area() const { return glm::length(this->areaVector); }
    glm::dvec3 centroid() const
    {
      return (this->corners[0] + this->corners[1] + this->corners[2]) / 3.0;
    }
    glm::dvec3 largest() const
    {
      return glm::max(glm::abs(this->corners[0]),
        glm::max(glm::abs(this->corners[1]), glm::abs(this->corners[2])));
    }
    double longestEdge() const
    {
      return std::max({ glm::distance(this->corners[0], this->corners[1]),
        glm::distance(this->corners[1], this->corners[2]),
        glm::distance(this->corners[2], this->corners[0]) });
    }
  };

  /// Cells of normals on a cube map of directions, in which opposite normals share a cell. A face's
  /// middle is a cell's middle, so axis-parallel planes stay in one cell.
  static constexpr int cellsPerSide = 63;

  static constexpr int directionCells = 3 * cellsPerSide * cellsPerSide;

  static int longestAxis(const glm::dvec3& normal)
  {
    const glm::dvec3 magnitude = glm::abs(normal);
    const int axis = magnitude.x >= magnitude.y ? 0 : 1;
    return magnitude[axis] >= magnitude.z ? axis : 2;
  }

  /// Return -1 for normals that count as their opposite, else 1.
  static double orientation(const glm::dvec3& normal)
  {
    return normal[longestAxis(normal)] < 0.0 ? -1.0 : 1.0;
  }

  static int directionCell(const glm::dvec3& normal)
  {
    const int axis = longestAxis(normal);
    const auto cell = [&](double component)
    {
      const double place = 0.5 * (component / normal[axis] + 1.0); // in [0, 1]
      return std::min(static_cast<int>(place * cellsPerSide), cellsPerSide - 1);
    };
    return (axis * cellsPerSide + cell(normal[(axis + 1) % 3])) * cellsPerSide +
      cell(normal[(axis + 2) % 3]);
  }

  /// Triangles with similar planes, from which a plane may grow.
  struct Candidate
  {
    std::vector<std::size_t> triangles;
    double area = 0.0;
    double largestArea = 0.0;
    std::size_t largest = 0; ///< number of the largest triangle
  };

  /// A sum over triangles on one plane. Their area vectors add up to that of their common outline,
  /// so errors of small triangles do not add up.
  struct PlaneSum
  {
    glm::dvec3 areaVector{ 0.0 };
    glm::dvec3 moment{ 0.0 };
    double area = 0.0;

    void add(const Triangle& triangle, const glm::dvec3& along)
    {
      const double weight = triangle.area();
      const double side = glm::dot(triangle.areaVector, along) < 0.0 ? -1.0 : 1.0;
      this->areaVector += side * triangle.areaVector;
      this->moment += weight * triangle.centroid();
      this->area += weight;
    }
    glm::dvec4 plane() const
    {
      const glm::dvec3 normal = glm::normalize(this->areaVector);
      return { normal, -glm::dot(normal, this->moment) / this->area };
    }
  };

  static double distanceOff(const glm::dvec4& plane, const glm::dvec3& point)
  {
    return std::abs(glm::dot(plane, glm::dvec4(point, 1.0)));
  }

  /// Return sum |n_i| |p_i|, which bounds the rounding of n.p.
  static double magnitudeAlong(const glm::dvec4& plane, const glm::dvec3& point)
  {
    return glm::dot(glm::abs(glm::dvec3(plane)), glm::abs(point));
  }

  /// Searches a snapshot for planes. It tests every triangle against every plane.
  class PlaneSearch
  {
  public:
    PlaneSearch(const Occluders& occluders, std::size_t wanted)
      : occluders_(occluders)
      , wanted_(wanted)
    {
    }

    double area() const { return this->area_; }
    /// Return for each triangle of the snapshot 0, or 1 + its plane.
    const std::vector<std::uint8_t>& planeOfTriangle() const { return this->planeOfTriangle_; }

    std::vector<ReceiverPlane> run()
    {
      this->planeOfTriangle_.assign(this->occluders_.triangles.size(), 0);
      this->collectFlat();
      std::vector<ReceiverPlane> planes;
      // Candidates fail where surfaces are almost flat. More tries than this are not worth their
      // time.
      int tries = 2 * mostPlanes;
      std::size_t before = 0;
      do
      {
        before = planes.size();
        for (const Candidate& candidate : this->candidates())
        {
          if (planes.size() == mostPlanes || tries-- <= 0 || this->hasLargerThan(candidate, planes))
          {
            break;
          }
          if (this->planeOfTriangle_[candidate.largest] == 0)
          {
            this->grow(candidate, planes);
          }
        }
        // Triangles left over from similar planes may form another plane.
      } while (planes.size() > before && planes.size() < mostPlanes);
      this->sortByArea(planes);
      return planes;
    }

  private:
    /// Collect the triangles in cells of direction with enough area.
    void collectFlat()
    {
      std::vector<double> areaOfDirection(directionCells, 0.0);
      const auto visitReceivers = [this](const auto& visit)
      {
        for (const Surface& surface : this->occluders_.surfaces)
        {
          const bool counts = surface.receives && !surface.isInstanced();
          for (std::uint32_t i = 0; counts && i < surface.triangleCount; ++i)
          {
            const std::size_t number = surface.firstTriangle + i;
            const Triangle triangle(this->occluders_, number);
            const double area = triangle.area();
            if (area > 0.0) // triangles without area have no direction
            {
              visit(number, triangle, area, directionCell(triangle.areaVector));
            }
          }
        }
      };
      for (const Surface& surface : this->occluders_.surfaces)
      {
        this->area_ +=
          surface.receives && surface.isInstanced() ? this->areaOfInstances(surface) : 0.0;
      }
      visitReceivers(
        [&](std::size_t, const Triangle&, double area, int cell)
        {
          areaOfDirection[static_cast<std::size_t>(cell)] += area;
          this->area_ += area;
        });
      visitReceivers(
        [&](std::size_t number, const Triangle&, double, int cell)
        {
          if (areaOfDirection[static_cast<std::size_t>(cell)] >= this->leastArea() * splitShare)
          {
            this->flat_.push_back(number);
          }
        });
    }

    /// Return the area of all instances, as if each were scaled evenly.
    double areaOfInstances(const Surface& surface) const
    {
      double areaSource = 0.0;
      for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
      {
        areaSource += Triangle(this->occluders_, surface.firstTriangle + i).area();
      }
      double scale = 0.0;
      for (const glm::mat4x3& instance : surface.centredFromSource)
      {
        scale += std::pow(std::abs(glm::determinant(glm::dmat3(instance))), 2.0 / 3.0);
      }
      return scale * areaSource;
    }

    /// Return the cells of direction and offset with enough area, the largest first.
    std::vector<Candidate> candidates() const
    {
      const double offsetCell =
        std::max(this->occluders_.allCentred.radius() / 2048.0, std::numeric_limits<double>::min());
      std::map<std::pair<int, long>, Candidate> cells;
      for (const std::size_t number : this->flat_)
      {
        if (this->planeOfTriangle_[number] != 0)
        {
          continue;
        }
        const Triangle triangle(this->occluders_, number);
        const double area = triangle.area();
        const int direction = directionCell(triangle.areaVector);
        const double offset = orientation(triangle.areaVector) *
          glm::dot(triangle.areaVector / area, triangle.centroid());
        Candidate& cell = cells[{ direction, std::lround(offset / offsetCell) }];
        cell.triangles.push_back(number);
        cell.area += area;
        if (area > cell.largestArea)
        {
          cell.largestArea = area;
          cell.largest = number;
        }
      }
      std::vector<Candidate> result;
      for (const auto& [place, cell] : cells)
      {
        if (cell.area >= this->leastArea() * splitShare)
        {
          result.push_back(cell);
        }
      }
      std::sort(result.begin(), result.end(),
        [](const Candidate& a, const Candidate& b)
        { return a.area != b.area ? a.area > b.area : a.largest < b.largest; });
      return result;
    }

    /// Return true if enough planes are larger than any plane that a candidate may be part of.
    bool hasLargerThan(const Candidate& candidate, const std::vector<ReceiverPlane>& planes) const
    {
      const auto larger = std::count_if(planes.begin(), planes.end(),
        [&](const ReceiverPlane& plane) { return plane.area * splitShare > candidate.area; });
      return static_cast<std::size_t>(larger) >= this->wanted_;
    }

    /// Find a plane from a candidate's largest triangle and all of its triangles that lie on that
    /// one's plane.
    void grow(const Candidate& candidate, std::vector<ReceiverPlane>& planes)
    {
      const Triangle seed(this->occluders_, candidate.largest);
      PlaneSum one;
      one.add(seed, seed.areaVector);
      const glm::dvec4 seedPlane = one.plane();
      // Rounding of a small triangle's corners rotates its plane, with errors that grow with
      // distance.
      const double height = 2.0 * seed.area() / seed.longestEdge();
      const glm::dvec3 middle = seed.centroid();
      PlaneSum sum;
      for (const std::size_t number : candidate.triangles)
      {
        if (this->planeOfTriangle_[number] == 0)
        {
          const Triangle triangle(this->occluders_, number);
          const auto near = [&](const glm::dvec3& corner)
          {
            const double noise =
              cornerNoise * magnitudeAlong(seedPlane, glm::max(glm::abs(corner), seed.largest()));
            return distanceOff(seedPlane, corner) <=
              noise * (1.0 + glm::distance(corner, middle) / height);
          };
          if (std::all_of(triangle.corners.begin(), triangle.corners.end(), near))
          {
            sum.add(triangle, seed.areaVector);
          }
        }
      }
      if (sum.area >= this->leastArea() * splitShare)
      {
        this->gather(sum.plane(), planes);
      }
    }

    /// Add a plane with all triangles that lie on it, if they have enough area.
    void gather(const glm::dvec4& plane, std::vector<ReceiverPlane>& planes)
    {
      ReceiverPlane found;
      found.plane = plane;
      double farthestOff = 0.0;
      double magnitude = std::abs(plane.w);
      std::vector<std::size_t> members;
      for (const std::size_t number : this->flat_)
      {
        if (this->planeOfTriangle_[number] != 0 || !this->isNear(plane, number))
        {
          continue;
        }
        const Triangle triangle(this->occluders_, number);
        const glm::dvec3 largest = triangle.largest();
        const auto on = [&](const glm::dvec3& corner)
        { return distanceOff(plane, corner) <= cornerNoise * magnitudeAlong(plane, largest); };
        if (std::all_of(triangle.corners.begin(), triangle.corners.end(), on))
        {
          members.push_back(number);
          found.area += triangle.area();
          magnitude = std::max(magnitude, magnitudeAlong(plane, largest));
          for (const glm::dvec3& corner : triangle.corners)
          {
            farthestOff = std::max(farthestOff, distanceOff(plane, corner));
            found.boundsCentred.add(corner);
          }
        }
      }
      if (found.area < this->leastArea() || members.empty())
      {
        return;
      }
      // An axis-parallel plane through the centre has no rounding. Its own triangles must not lie
      // before it even then.
      const glm::dvec3 farthest =
        glm::max(glm::abs(found.boundsCentred.lower), glm::abs(found.boundsCentred.upper));
      const double size = std::max({ farthest.x, farthest.y, farthest.z });
      found.thickness = farthestOff + evaluationNoise * std::max(magnitude, size);
      planes.push_back(found);
      for (const std::size_t number : members)
      {
        this->planeOfTriangle_[number] = static_cast<std::uint8_t>(planes.size());
      }
    }

    /// Return true if a triangle's first corner may lie on a plane, by the rounding of the whole
    /// scene. This cheap test rejects nearly all others.
    bool isNear(const glm::dvec4& plane, std::size_t number) const
    {
      const glm::dvec3 corner =
        this->occluders_.positionsCentred[this->occluders_.triangles[number].x];
      const Bounds& all = this->occluders_.allCentred;
      const glm::dvec3 largest = glm::max(glm::abs(all.lower), glm::abs(all.upper));
      return distanceOff(plane, corner) <= cornerNoise * magnitudeAlong(plane, largest);
    }

    /// Sort planes by area, and drop all but the wanted number.
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

    double leastArea() const { return ReceiverPlanes::smallestShare * this->area_; }
    /// A plane near the borders of cells may be spread over this many.
    static constexpr double splitShare = 1.0 / 8.0;

    const Occluders& occluders_;
    std::size_t wanted_;
    double area_ = 0.0;
    std::vector<std::size_t> flat_;
    std::vector<std::uint8_t> planeOfTriangle_;
  };

  std::vector<ReceiverPlane> planes_;
  std::vector<std::uint8_t> planeOfTriangle_;
  double area_ = 0.0;
  std::size_t wanted_ = 0; ///< 0 before the first update
  Occluders::Versions versions_;
};

} // namespace gnomon
