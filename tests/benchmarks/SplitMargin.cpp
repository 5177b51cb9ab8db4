#include "SplitMargin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::test
{
namespace
{

/// Float's unit roundoff.
constexpr double roundoff = 5.9604644775390625e-8; // 2^-24

/// Return a test's value over the rounding of its terms; a value of 0 has no terms to divide by.
double inRoundings(double value, double terms)
{
  return value == 0.0 ? 0.0 : value / (roundoff * terms);
}

/// Return a triangle's margin.
/// @param v the corners from the ray's origin
/// @param normal (v1 - v0) x (v2 - v0)
RayMargin marginOf(const std::array<glm::dvec3, 3>& v, const glm::dvec3& normal,
  const glm::dvec3& direction, double rayFar)
{
  const double length = glm::length(direction);
  const double along = glm::dot(normal, direction);
  const double sign = along < 0.0 ? -1.0 : 1.0;
  RayMargin margin{ std::numeric_limits<double>::infinity(), RayMargin::Test::Edge };
  const auto take = [&](double value, double terms, RayMargin::Test test)
  {
    const double roundings = inRoundings(value, terms);
    if (roundings < margin.roundings)
    {
      margin = { roundings, test };
    }
  };
  double longest = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    // Embree multiplies edge, sum of corners and direction. It accepts negative values up to 2^-23
    // of the three edges' sum, which is 2 |N.D|.
    const std::size_t j = (i + 1) % 3;
    const double edge = glm::length(v[j] - v[i]);
    take(2.0 * sign * glm::dot(direction, glm::cross(v[i], v[j])),
      edge * glm::length(v[i] + v[j]) * length + 2.0 * std::abs(along), RayMargin::Test::Edge);
    longest = std::max(longest, edge);
    farthest = std::max(farthest, glm::length(v[i]));
  }
  // The plane's distance is the volume of the three corners. Rounding them moves it by their
  // largest face.
  const double distance = sign * glm::dot(normal, v[0]);
  const double face = longest * farthest;
  take(distance, face * farthest, RayMargin::Test::Start);
  if (std::isfinite(rayFar))
  {
    take(rayFar * std::abs(along) - distance, face * (farthest + rayFar * length),
      RayMargin::Test::End);
  }
  return margin;
}

} // namespace

//------------------------------------------------------------------------------
RayMargin marginOf(const Occluders& occluders, const TestedRay& ray)
{
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 direction(ray.direction);
  RayMargin most{ -std::numeric_limits<double>::infinity(), RayMargin::Test::Edge };
  for (const Surface& surface : occluders.surfaces)
  {
    const std::uint32_t end = surface.firstTriangle + (surface.casts ? surface.triangleCount : 0);
    for (std::uint32_t triangle = surface.firstTriangle; triangle < end; ++triangle)
    {
      std::array<glm::dvec3, 3> v;
      for (int i = 0; i < 3; ++i)
      {
        v[static_cast<std::size_t>(i)] =
          glm::dvec3(occluders.positionsCentred[occluders.triangles[triangle][i]]) - origin;
      }
      const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
      if (surface.oneSided && !(glm::dot(normal, direction) > 0.0))
      {
        continue;
      }
      const RayMargin margin = marginOf(v, normal, direction, ray.rayFar);
      if (margin.roundings > most.roundings)
      {
        most = margin;
      }
    }
  }
  return most;
}

} // namespace gnomon::test
