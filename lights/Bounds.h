#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon
{

/// An axis-aligned box. It is empty until a point is added; an empty box has lower > upper.
struct Bounds
{
  glm::dvec3 lower{ std::numeric_limits<double>::infinity() };
  glm::dvec3 upper{ -std::numeric_limits<double>::infinity() };

  bool empty() const
  {
    return !(this->lower.x <= this->upper.x && this->lower.y <= this->upper.y &&
      this->lower.z <= this->upper.z);
  }
  void add(const glm::dvec3& point)
  {
    this->lower = glm::min(this->lower, point);
    this->upper = glm::max(this->upper, point);
  }
  void add(const Bounds& other)
  {
    this->lower = glm::min(this->lower, other.lower);
    this->upper = glm::max(this->upper, other.upper);
  }
  glm::dvec3 centre() const { return 0.5 * (this->lower + this->upper); }
  /// Half the diagonal: the radius of the sphere around the box. 0 for an empty box.
  double radius() const
  {
    return this->empty() ? 0.0 : 0.5 * glm::length(this->upper - this->lower);
  }
  std::array<glm::dvec3, 8> corners() const
  {
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
    {
      result[static_cast<std::size_t>(i)] = { (i & 1) ? this->upper.x : this->lower.x,
        (i & 2) ? this->upper.y : this->lower.y, (i & 4) ? this->upper.z : this->lower.z };
    }
    return result;
  }
};

/// The largest magnitude of a coordinate of the world. Larger ones, and those that are not finite,
/// mark missing data, as the largest float does in rasters.
constexpr double largestOfWorld = 0x1p100;

/// True if every coordinate is a number of at most this magnitude.
inline bool isWithin(const glm::dvec3& point, double largest)
{
  return glm::all(glm::lessThanEqual(glm::abs(point), glm::dvec3(largest))); // false for NaN
}
/// True if a box that is not empty is.
inline bool isWithin(const Bounds& bounds, double largest)
{
  return isWithin(bounds.lower, largest) && isWithin(bounds.upper, largest);
}

/// Return the largest magnitude of a coordinate in a box; minus infinity in an empty one.
inline double largestCoordinate(const Bounds& bounds)
{
  const glm::dvec3 largest = glm::max(-bounds.lower, bounds.upper);
  return std::max(largest.x, std::max(largest.y, largest.z));
}

/// Return the box grown by `by` on all sides. An empty box stays empty.
inline Bounds inflated(const Bounds& bounds, double by)
{
  return { bounds.lower - by, bounds.upper + by };
}

/// Return the axis-aligned box around an affinely transformed box.
inline Bounds affinelyTransformed(const Bounds& bounds, const glm::dmat4& matrix)
{
  Bounds result;
  for (const glm::dvec3& corner : bounds.corners())
  {
    result.add(glm::dvec3(matrix * glm::dvec4(corner, 1.0)));
  }
  return result;
}

/// True if a projection may show part of a box; false only if it shows nothing of it. Parts in
/// front of the near plane or behind the far plane count as shown.
inline bool mayShow(const glm::dmat4& clipFromSpace, const Bounds& bounds)
{
  if (bounds.empty())
  {
    return false;
  }
  // The number of corners outside each plane that bounds clip space.
  std::array<int, 5> outside{};
  for (const glm::dvec3& corner : bounds.corners())
  {
    const glm::dvec4 clip = clipFromSpace * glm::dvec4(corner, 1.0);
    outside[0] += clip.x < -clip.w ? 1 : 0;
    outside[1] += clip.x > clip.w ? 1 : 0;
    outside[2] += clip.y < -clip.w ? 1 : 0;
    outside[3] += clip.y > clip.w ? 1 : 0;
    outside[4] += clip.w <= 0.0 ? 1 : 0;
  }
  return std::none_of(outside.begin(), outside.end(), [](int corners) { return corners == 8; });
}

} // namespace gnomon
