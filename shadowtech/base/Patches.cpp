#include "shadowtech/base/Patches.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SmoothFacet.h"
#include "shadowtech/base/WeldedVertices.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <numeric>

namespace gnomon
{
namespace
{

/// Return a root of a tree of numbers, and shorten the way to it.
std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t number)
{
  while (parents[number] != number)
  {
    number = parents[number] = parents[parents[number]];
  }
  return number;
}

std::vector<std::uint32_t> connect(const Occluders& occluders, const Surface& surface)
{
  const std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
  const auto edgeOf = [&](std::uint32_t side)
  {
    const glm::uvec3 corners =
      occluders.triangles[surface.firstTriangle + side / 3] - surface.firstVertex;
    const auto i = static_cast<glm::length_t>(side % 3);
    return std::minmax({ welded[corners[i]], welded[corners[(i + 1) % 3]] });
  };
  std::vector<std::uint32_t> numbers(surface.triangleCount);
  std::iota(numbers.begin(), numbers.end(), 0u);
  FirstOfSame first(3 * numbers.size());
  for (std::uint32_t side = 0; side < 3 * surface.triangleCount; ++side)
  {
    const auto edge = edgeOf(side);
    const std::uint32_t same = first.of(side, hashOf({ { edge.first, edge.second, 0 } }),
      [&](std::uint32_t other) { return edgeOf(other) == edge; });
    numbers[rootOf(numbers, side / 3)] = rootOf(numbers, same / 3);
  }
  for (std::uint32_t& number : numbers)
  {
    number = rootOf(numbers, number);
  }
  return numbers;
}

std::vector<std::uint8_t> findCreases(const Occluders& occluders, const Surface& surface)
{
  const glm::mat3 turn(
    surface.isInstanced() ? glm::dmat3(1.0) : normalMatrix(glm::dmat3(surface.centredFromNormals)));
  std::vector<std::uint8_t> creased(surface.vertexCount, 0);
  for (std::uint32_t triangle = 0; triangle < surface.triangleCount; ++triangle)
  {
    const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + triangle];
    const auto at = [&](int i) { return occluders.positionsCentred[corners[i]]; };
    const glm::vec3 across = glm::cross(at(1) - at(0), at(2) - at(0));
    for (int i = 0; i < 3; ++i)
    {
      const std::uint32_t vertex = corners[i] - surface.firstVertex;
      const glm::vec3 normal = turn * surface.pointNormals[vertex];
      // Normals may point to either side.
      if (std::abs(glm::dot(normal, across)) <
        leastCosineOfCurve * glm::length(normal) * glm::length(across))
      {
        creased[vertex] = 1;
      }
    }
  }
  return creased;
}

} // namespace

const std::vector<std::uint32_t>& Patches::numbers(
  const Occluders& occluders, const Surface& surface)
{
  const std::lock_guard<std::mutex> lock(this->mutex_);
  if (this->numbers_.empty())
  {
    this->numbers_ = connect(occluders, surface);
  }
  return this->numbers_;
}

bool Patches::isAtCrease(const Occluders& occluders, const Surface& surface, std::uint32_t triangle)
{
  if (this->positionsVersion_.load(std::memory_order_acquire) != surface.positionsVersion)
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    if (this->positionsVersion_.load(std::memory_order_relaxed) != surface.positionsVersion)
    {
      this->creased_ = findCreases(occluders, surface);
      this->positionsVersion_.store(surface.positionsVersion, std::memory_order_release);
    }
  }
  const glm::uvec3 corners = occluders.triangles[triangle] - surface.firstVertex;
  return (this->creased_[corners.x] | this->creased_[corners.y] | this->creased_[corners.z]) != 0;
}

std::size_t Patches::bytes() const
{
  return sizeof(*this) + bytesOf(this->numbers_) + bytesOf(this->creased_);
}

} // namespace gnomon
