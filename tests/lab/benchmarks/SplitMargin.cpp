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

/// The margin of one triangle.
struct TriangleMargin
{
  double roundings;
  bool isOfEdge; ///< an edge's test has it
};

/// Return a triangle's margin.
/// @param v the corners from the ray's origin
/// @param normal (v1 - v0) x (v2 - v0)
TriangleMargin marginOf(const std::array<glm::dvec3, 3>& v, const glm::dvec3& normal,
  const glm::dvec3& direction, double rayFar)
{
  const double length = glm::length(direction);
  const double along = glm::dot(normal, direction);
  const double sign = along < 0.0 ? -1.0 : 1.0;
  TriangleMargin margin{ std::numeric_limits<double>::infinity(), true };
  const auto take = [&](double value, double terms, bool isOfEdge)
  {
    const double roundings = inRoundings(value, terms);
    if (roundings < margin.roundings)
    {
      margin = { roundings, isOfEdge };
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
      edge * glm::length(v[i] + v[j]) * length + 2.0 * std::abs(along), true);
    longest = std::max(longest, edge);
    farthest = std::max(farthest, glm::length(v[i]));
  }
  // The plane's distance is the volume of the three corners. Rounding them moves it by their
  // largest face.
  const double distance = sign * glm::dot(normal, v[0]);
  const double face = longest * farthest;
  take(distance, face * farthest, false);
  if (std::isfinite(rayFar))
  {
    take(rayFar * std::abs(along) - distance, face * (farthest + rayFar * length), false);
  }
  return margin;
}

} // namespace

//------------------------------------------------------------------------------
RayMargin marginOf(const Occluders& occluders, const TestedRay& ray)
{
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 direction(ray.direction);
  constexpr double none = -std::numeric_limits<double>::infinity();
  RayMargin most{ none, none };
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
      const TriangleMargin margin = marginOf(v, normal, direction, ray.rayFar);
      most.roundings = std::max(most.roundings, margin.roundings);
      most.edgeRoundings = std::max(most.edgeRoundings, margin.isOfEdge ? margin.roundings : none);
    }
  }
  return most;
}

} // namespace gnomon::test
