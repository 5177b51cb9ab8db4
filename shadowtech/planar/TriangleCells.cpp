#include "shadowtech/planar/TriangleCells.h"

#include "shadowtech/base/Occluders.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// Of a face of the cube map of directions. The middle of a face is the middle of a cell, so that
/// axis-parallel planes stay in one.
constexpr int cellsPerSide = 63;
static_assert(TriangleCells::directionCount == 3 * cellsPerSide * cellsPerSide);

/// The bits of a triangle's number in its block, and of an offset's.
constexpr int numberBits = 14;
constexpr int offsetBits = 34;
static_assert(TriangleBlock::mostTriangles == 1u << numberBits);

int longestAxis(const glm::dvec3& normal)
{
  const glm::dvec3 magnitude = glm::abs(normal);
  const int axis = magnitude.x >= magnitude.y ? 0 : 1;
  return magnitude[axis] >= magnitude.z ? axis : 2;
}

int directionOf(const glm::dvec3& normal)
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

/// The cell of a triangle's plane: its direction and, behind it, its distance from the origin.
std::uint64_t cellOf(const ReceivingTriangle& triangle, double area, double offsetCell)
{
  const glm::dvec3& normal = triangle.areaVector;
  const double side = normal[longestAxis(normal)] < 0.0 ? -1.0 : 1.0;
  const double offset = side * glm::dot(normal, triangle.centroid()) / (area * offsetCell);
  constexpr auto half = static_cast<double>(std::uint64_t(1) << (offsetBits - 1));
  // Only a scene that is tiny beside its distance from the centre could have more cells than that.
  const double bounded = std::clamp(std::round(offset) + half, 0.0, 2.0 * half - 1.0);
  return static_cast<std::uint64_t>(directionOf(normal)) << offsetBits |
    static_cast<std::uint64_t>(bounded);
}

int directionOf(std::uint64_t key)
{
  return static_cast<int>(key >> offsetBits);
}

/// As if each instance were scaled evenly.
double areaOfInstances(const Surface& surface, const Occluders& occluders)
{
  double areaSource = 0.0;
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    areaSource += ReceivingTriangle(occluders, surface.firstTriangle + i).area();
  }
  double scale = 0.0;
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    scale += std::pow(std::abs(glm::determinant(glm::dmat3(instance))), 2.0 / 3.0);
  }
  return scale * areaSource;
}

std::vector<TriangleBlock> blocksOf(const Surface& surface)
{
  std::vector<TriangleBlock> blocks;
  for (std::uint32_t first = 0; first < surface.triangleCount;
       first += TriangleBlock::mostTriangles)
  {
    blocks.emplace_back(
      first, std::min(surface.triangleCount - first, TriangleBlock::mostTriangles));
  }
  return blocks;
}

/// A cell's extent along its normal: a power of two, so that it seldom changes with the scene's size.
double offsetCellOf(const Occluders& occluders)
{
  const double least =
    std::max(occluders.allCentred.radius() / 2048.0, std::numeric_limits<double>::min());
  return std::exp2(std::ceil(std::log2(least)));
}

} // namespace

//------------------------------------------------------------------------------
void TriangleBlock::sort(const Occluders& occluders, std::size_t surfaceFirst, double offsetCell)
{
  struct Measures
  {
    double area;
    double height;
  };
  std::vector<Measures> measures(this->count_);
  std::vector<std::uint64_t> keys; // a cell's key, and behind it the triangle's number
  keys.reserve(this->count_);
  for (std::uint32_t i = 0; i < this->count_; ++i)
  {
    const ReceivingTriangle triangle(occluders, surfaceFirst + this->first_ + i);
    const double area = triangle.area();
    if (area > 0.0) // what has none has no direction
    {
      measures[i] = { area, triangle.height() };
      keys.push_back(cellOf(triangle, area, offsetCell) << numberBits | i);
    }
  }
  std::sort(keys.begin(), keys.end());

  this->offsetCell_ = offsetCell;
  this->area_ = 0.0;
  this->directions_.clear();
  this->cells_.clear();
  this->triangles_.clear();
  this->boxes_.clear();
  for (const std::uint64_t numbered : keys)
  {
    const std::uint64_t key = numbered >> numberBits;
    const auto number = static_cast<std::uint16_t>(numbered & (mostTriangles - 1));
    const auto [area, height] = measures[number];
    if (this->directions_.empty() || this->directions_.back().number != directionOf(key))
    {
      this->directions_.emplace_back().number = directionOf(key);
    }
    if (this->cells_.empty() || this->cells_.back().key != key)
    {
      this->cells_.emplace_back().key = key;
      this->cells_.back().begin = static_cast<std::uint32_t>(this->triangles_.size());
    }
    this->triangles_.push_back(number);
    this->area_ += area;
    Direction& direction = this->directions_.back();
    direction.area += area;
    direction.leastHeight = std::min(direction.leastHeight, height);
    Cell& cell = this->cells_.back();
    cell.area += area;
    cell.end = static_cast<std::uint32_t>(this->triangles_.size());
    if (area > cell.largestArea)
    {
      cell.largestArea = area;
      cell.largest = number;
    }
  }
}

//------------------------------------------------------------------------------
bool TriangleBlock::keep(
  const Occluders& occluders, std::size_t surfaceFirst, const std::vector<char>& isWanted)
{
  const auto wanted = [&](const Direction& direction)
  { return isWanted[static_cast<std::size_t>(direction.number)] != 0; };
  const bool isNew = this->boxes_.empty();
  const bool isSame = std::all_of(this->directions_.begin(), this->directions_.end(),
    [&](const Direction& direction) { return direction.isKept == wanted(direction); });
  if (!isNew && isSame)
  {
    return false;
  }
  const bool isGone = std::any_of(this->directions_.begin(), this->directions_.end(),
    [&](const Direction& direction) { return wanted(direction) && !direction.isKept; });
  if (isGone)
  {
    this->sort(occluders, surfaceFirst, this->offsetCell_);
  }
  for (Direction& direction : this->directions_)
  {
    direction.isKept = wanted(direction);
  }
  this->dropUnkept();
  this->makeBoxes(occluders, surfaceFirst);
  return isGone;
}

//------------------------------------------------------------------------------
void TriangleBlock::dropUnkept()
{
  std::vector<Cell> cells;
  std::vector<std::uint16_t> triangles;
  auto cell = this->cells_.begin();
  for (Direction& direction : this->directions_)
  {
    direction.begin = static_cast<std::uint32_t>(triangles.size());
    for (; cell != this->cells_.end() && directionOf(cell->key) == direction.number; ++cell)
    {
      if (direction.isKept)
      {
        const auto place = static_cast<std::uint32_t>(triangles.size());
        triangles.insert(triangles.end(), this->triangles_.begin() + cell->begin,
          this->triangles_.begin() + cell->end);
        cells.push_back(*cell);
        cells.back().begin = place;
        cells.back().end = static_cast<std::uint32_t>(triangles.size());
      }
    }
    direction.end = static_cast<std::uint32_t>(triangles.size());
  }
  cells.shrink_to_fit();
  triangles.shrink_to_fit();
  this->cells_ = std::move(cells);
  this->triangles_ = std::move(triangles);
}

//------------------------------------------------------------------------------
void TriangleBlock::makeBoxes(const Occluders& occluders, std::size_t surfaceFirst)
{
  this->boxes_.clear();
  for (Direction& direction : this->directions_)
  {
    direction.firstBox = static_cast<std::uint32_t>(this->boxes_.size());
    for (std::uint32_t i = direction.begin; i < direction.end; ++i)
    {
      const glm::uvec3& corners =
        occluders.triangles[surfaceFirst + this->first_ + this->triangles_[i]];
      if ((i - direction.begin) % trianglesPerBox == 0)
      {
        const glm::vec3& corner = occluders.positionsCentred[corners.x];
        this->boxes_.push_back({ corner, corner });
      }
      TriangleBox& box = this->boxes_.back();
      for (int k = 0; k < 3; ++k)
      {
        box.lower = glm::min(box.lower, occluders.positionsCentred[corners[k]]);
        box.upper = glm::max(box.upper, occluders.positionsCentred[corners[k]]);
      }
    }
  }
  this->boxes_.shrink_to_fit();
}

//------------------------------------------------------------------------------
double TriangleCells::leastSine(const glm::dvec3& normal, int direction)
{
  const int axis = direction / (cellsPerSide * cellsPerSide);
  const auto middle = [](int cell) { return (2.0 * cell + 1.0) / cellsPerSide - 1.0; };
  glm::dvec3 centre;
  centre[axis] = 1.0;
  centre[(axis + 1) % 3] = middle(direction / cellsPerSide % cellsPerSide);
  centre[(axis + 2) % 3] = middle(direction % cellsPerSide);
  // A cell's corners are off its middle by sqrt(2) / cellsPerSide on the cube's face, which is no nearer than 1.
  return glm::length(glm::cross(normal, glm::normalize(centre))) - std::sqrt(2.0) / cellsPerSide;
}

//------------------------------------------------------------------------------
void TriangleCells::update(const Occluders& occluders, double leastShare)
{
  this->findSurfaces(occluders);
  std::vector<double> areas(directionCount, 0.0);
  for (const PlacedBlock& placed : this->blocks_)
  {
    this->area_ += placed.block->area();
    for (const TriangleBlock::Direction& direction : placed.block->directions())
    {
      areas[static_cast<std::size_t>(direction.number)] += direction.area;
    }
  }
  this->isWanted_.clear();
  for (const double area : areas)
  {
    this->isWanted_.push_back(area >= leastShare * this->area_ ? 1 : 0);
  }
  std::atomic<std::size_t> again{ 0 };
  tbb::parallel_for(std::size_t(0), this->blocks_.size(),
    [&](std::size_t i)
    {
      const PlacedBlock& placed = this->blocks_[i];
      if (placed.block->keep(occluders, placed.surfaceFirst, this->isWanted_))
      {
        again += placed.block->count();
      }
    });
  this->sortedTriangles_ += again;
}

//------------------------------------------------------------------------------
/// Takes over what is known of surfaces, sorts the others, and forgets those that are gone.
void TriangleCells::findSurfaces(const Occluders& occluders)
{
  const double offsetCell = offsetCellOf(occluders);
  std::unordered_map<std::uint64_t, ReceivingSurface> before = std::move(this->surfaces_);
  std::vector<PlacedBlock> unknown;
  this->surfaces_.clear();
  this->blocks_.clear();
  this->area_ = 0.0;
  this->sortedTriangles_ = 0;
  for (const Surface& surface : occluders.surfaces)
  {
    if (!surface.receives)
    {
      continue;
    }
    ReceivingSurface& receiving = this->surfaces_[surface.positionsVersion];
    const auto known = before.find(surface.positionsVersion);
    if (known != before.end())
    {
      receiving = std::move(known->second);
    }
    else if (surface.isInstanced())
    {
      receiving.areaOfInstances = areaOfInstances(surface, occluders);
    }
    else
    {
      receiving.blocks = blocksOf(surface);
    }
    this->area_ += receiving.areaOfInstances;
    for (TriangleBlock& block : receiving.blocks)
    {
      this->blocks_.push_back({ &block, surface.firstTriangle });
      if (block.offsetCell() != offsetCell)
      {
        unknown.push_back(this->blocks_.back());
        this->sortedTriangles_ += block.count();
      }
    }
  }
  tbb::parallel_for(std::size_t(0), unknown.size(),
    [&](std::size_t i) { unknown[i].block->sort(occluders, unknown[i].surfaceFirst, offsetCell); });
}

} // namespace gnomon
