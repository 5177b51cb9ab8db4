#ifndef gnomon_shadowtech_planar_TriangleCells_h
#define gnomon_shadowtech_planar_TriangleCells_h

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace gnomon
{

/// A receiving triangle of the snapshot.
struct ReceivingTriangle
{
  std::array<glm::dvec3, 3> corners; ///< centred
  glm::dvec3 areaVector;             ///< normal, as long as the area

  ReceivingTriangle(const Occluders& occluders, std::size_t number)
  {
    const glm::uvec3& numbers = occluders.triangles[number];
    this->corners = { occluders.positionsCentred[numbers.x], occluders.positionsCentred[numbers.y],
      occluders.positionsCentred[numbers.z] };
    this->areaVector =
      0.5 * glm::cross(this->corners[1] - this->corners[0], this->corners[2] - this->corners[0]);
  }

  double area() const { return glm::length(this->areaVector); }
  glm::dvec3 centroid() const
  {
    return (this->corners[0] + this->corners[1] + this->corners[2]) / 3.0;
  }
  /// By axis, the largest magnitude of a corner's coordinate.
  glm::dvec3 largest() const
  {
    return glm::max(
      glm::abs(this->corners[0]), glm::max(glm::abs(this->corners[1]), glm::abs(this->corners[2])));
  }
  /// The shortest of its heights.
  double height() const
  {
    const auto squared = [](const glm::dvec3& edge) { return glm::dot(edge, edge); };
    const double longest = std::max({ squared(this->corners[0] - this->corners[1]),
      squared(this->corners[1] - this->corners[2]), squared(this->corners[2] - this->corners[0]) });
    return 2.0 * std::sqrt(glm::dot(this->areaVector, this->areaVector) / longest);
  }
};

/// A box around some triangles' corners, in centred coordinates.
struct TriangleBox
{
  glm::vec3 lower;
  glm::vec3 upper;
};

/// Up to `mostTriangles` triangles that follow each other in a surface, sorted into *cells*: those of a
/// cell have planes that are much alike, in direction (of a cube map of normals, where opposite ones are
/// the same) and in distance from the origin.
class TriangleBlock
{
public:
  static constexpr std::uint32_t mostTriangles = 1u << 14;
  /// How many triangles of a direction share a box.
  static constexpr std::uint32_t trianglesPerBox = 64;

  /// What a direction has of the block.
  struct Direction
  {
    int number = 0;
    double area = 0.0;
    double leastHeight = std::numeric_limits<double>::infinity(); ///< of its triangles
    bool isKept = true;
    std::uint32_t begin = 0; ///< of triangles(), if it is kept
    std::uint32_t end = 0;
    std::uint32_t firstBox = 0; ///< of boxes(), for every trianglesPerBox of these
  };
  /// What a cell has of the block.
  struct Cell
  {
    std::uint64_t key = 0; ///< the same in all blocks; cells are in order of it
    double area = 0.0;
    double largestArea = 0.0;
    std::uint16_t largest = 0; ///< the triangle
    std::uint32_t begin = 0;   ///< of triangles()
    std::uint32_t end = 0;
  };

  /// @param first,count in the surface's triangles
  TriangleBlock(std::uint32_t first, std::uint32_t count)
    : first_(first)
    , count_(count)
  {
  }

  /// Sorts all triangles into cells.
  /// @param surfaceFirst the surface's first triangle in the snapshot
  /// @param offsetCell a cell's extent along its normal, in world units, > 0
  void sort(const Occluders& occluders, std::size_t surfaceFirst, double offsetCell);
  /// Keeps the cells of these directions only; sorts again if some of them are gone.
  /// @param isWanted by direction
  /// @return whether it has sorted again
  bool keep(
    const Occluders& occluders, std::size_t surfaceFirst, const std::vector<char>& isWanted);

  std::uint32_t first() const { return this->first_; }
  std::uint32_t count() const { return this->count_; }
  double offsetCell() const { return this->offsetCell_; } ///< of the last sort(); 0 before it
  double area() const { return this->area_; }             ///< of all triangles
  const std::vector<Direction>& directions() const { return this->directions_; } ///< of all
  const std::vector<Cell>& cells() const { return this->cells_; }
  /// Those that are kept: numbers from first() on, in order of their cells.
  const std::vector<std::uint16_t>& triangles() const { return this->triangles_; }
  const std::vector<TriangleBox>& boxes() const { return this->boxes_; }

private:
  void dropUnkept();
  void makeBoxes(const Occluders& occluders, std::size_t surfaceFirst);

  std::uint32_t first_;
  std::uint32_t count_;
  double offsetCell_ = 0.0;
  double area_ = 0.0;
  std::vector<Direction> directions_;
  std::vector<Cell> cells_;
  std::vector<std::uint16_t> triangles_;
  std::vector<TriangleBox> boxes_;
};

/// The triangles of all surfaces that receive and are drawn once, in cells. A surface that has not
/// changed since the last update is not looked at again.
class TriangleCells
{
public:
  /// How many directions are told apart.
  static constexpr int directionCount = 3 * 63 * 63;
  /// The least sine of the angle between a unit normal and the normals of a direction, or less.
  static double leastSine(const glm::dvec3& normal, int direction);

  TriangleCells() = default;
  TriangleCells(const TriangleCells&) = delete; // blocks() points into surfaces_
  TriangleCells& operator=(const TriangleCells&) = delete;

  /// A block, and where its triangles are in the snapshot.
  struct PlacedBlock
  {
    TriangleBlock* block;
    std::size_t surfaceFirst; ///< the surface's first triangle

    std::size_t first() const { return this->surfaceFirst + this->block->first(); }
  };

  /// Brings the cells up to date with a snapshot.
  /// @param leastShare of all receivers' area: directions that have less of it are left out
  void update(const Occluders& occluders, double leastShare);

  /// Of all receivers, those that are drawn as instances, too.
  double area() const { return this->area_; }
  /// In order of the snapshot's triangles.
  const std::vector<PlacedBlock>& blocks() const { return this->blocks_; }
  /// By direction: whether it has enough area.
  const std::vector<char>& isWanted() const { return this->isWanted_; }
  /// How many triangles the last update has sorted into cells.
  std::size_t sortedTriangles() const { return this->sortedTriangles_; }

private:
  struct ReceivingSurface
  {
    double areaOfInstances = 0.0;
    std::vector<TriangleBlock> blocks;
  };

  void findSurfaces(const Occluders& occluders);

  std::unordered_map<std::uint64_t, ReceivingSurface> surfaces_; ///< by Surface::positionsVersion
  std::vector<PlacedBlock> blocks_;
  std::vector<char> isWanted_;
  double area_ = 0.0;
  std::size_t sortedTriangles_ = 0;
};

} // namespace gnomon

#endif
