#pragma once

#include "RandomScenes.h"

#include "shadowtech/mesh/CasterShapes.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

/// @file
/// Triangles on the texels of a map, and plane geometry for comparison with the rasteriser.

namespace gnomon::test
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// x and y in texels, z the depth.
using Corners = std::array<glm::dvec3, 3>;

/// Return the area between two vectors, positive if the second lies to the left of the first.
inline double perp(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// Return twice the area of a triangle, positive if it is counter-clockwise.
inline double doubleAreaOf(const Corners& corners)
{
  return perp(glm::dvec2(corners[1] - corners[0]), glm::dvec2(corners[2] - corners[0]));
}

/// Return a triangle of any size from a hundredth of a texel to the whole map, wound either way.
/// Each third one is a sliver.
inline Corners randomTriangle(Random& random, int width)
{
  const double size = std::pow(10.0, uniform(random, -2.0, 1.5));
  const double flat = random() % 3 ? 1.0 : std::pow(10.0, uniform(random, -4.0, 0.0));
  const double angle = uniform(random, 0.0, 6.283185307179586);
  const glm::dvec2 along(std::cos(angle), std::sin(angle));
  const glm::dvec2 middle(uniform(random, 0.0, width), uniform(random, 0.0, width));
  Corners corners;
  for (glm::dvec3& corner : corners)
  {
    const glm::dvec2 place(uniform(random, -1.0, 1.0), flat * uniform(random, -1.0, 1.0));
    const glm::dvec2 turned(place.x * along - place.y * glm::dvec2(along.y, -along.x));
    corner = glm::dvec3(middle + size * turned, uniform(random, 0.0, 1.0));
  }
  return corners;
}

/// Return the shape to draw: a caster that covers.
inline MapPolygon polygonWith(const Corners& corners)
{
  MapPolygon polygon;
  polygon.count = 3;
  polygon.role.present = polygon.role.covers = true;
  polygon.facing = 1;
  for (std::uint8_t k = 0; k < 3; ++k)
  {
    polygon.corners[k] = { corners[k].x, corners[k].y, corners[k].z };
    polygon.sides[k] = k;
  }
  return polygon;
}

inline bool isInside(const Corners& corners, const glm::dvec2& point)
{
  const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
  const double sign = doubleAreaOf(corners) > 0.0 ? 1.0 : -1.0;
  return sign * perp(b - a, point - a) >= 0.0 && sign * perp(c - b, point - b) >= 0.0 &&
    sign * perp(a - c, point - c) >= 0.0;
}

/// True if a triangle and a cell have a point in common, by separating axes.
inline bool overlap(const Corners& corners, const glm::dvec2& low, const glm::dvec2& high)
{
  std::vector<glm::dvec2> axes{ { 1.0, 0.0 }, { 0.0, 1.0 } };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2 edge(corners[(k + 1) % 3] - corners[k]);
    axes.emplace_back(-edge.y, edge.x);
  }
  return std::all_of(axes.begin(), axes.end(),
    [&](const glm::dvec2& axis)
    {
      double least = infinity, most = -infinity;
      for (const glm::dvec3& corner : corners)
      {
        const double at = glm::dot(axis, glm::dvec2(corner));
        least = std::min(least, at);
        most = std::max(most, at);
      }
      const glm::dvec2 middle = 0.5 * (low + high);
      const double reach = glm::dot(glm::abs(axis), 0.5 * (high - low));
      return glm::dot(axis, middle) + reach >= least && glm::dot(axis, middle) - reach <= most;
    });
}

/// True if all of a cell lies in a triangle.
inline bool contains(const Corners& corners, const glm::dvec2& low, const glm::dvec2& high)
{
  return isInside(corners, low) && isInside(corners, high) &&
    isInside(corners, { low.x, high.y }) && isInside(corners, { high.x, low.y });
}

/// Return the depth of a triangle's plane.
inline auto depthOf(const Corners& corners)
{
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  return [corner = corners[0], normal](const glm::dvec2& point)
  { return corner.z - glm::dot(glm::dvec2(normal), point - glm::dvec2(corner)) / normal.z; };
}

/// A line: all p with normal.p = c.
struct Line
{
  glm::dvec2 normal;
  double c;

  double distance(const glm::dvec2& point) const { return glm::dot(this->normal, point) - this->c; }
};

inline glm::dvec2 crossing(const Line& a, const Line& b)
{
  return glm::dvec2(a.c * b.normal.y - b.c * a.normal.y, a.normal.x * b.c - b.normal.x * a.c) /
    perp(a.normal, b.normal);
}

/// Return the line from one point to another.
/// @param inwards 1 or -1: which side of the line, left or right, is inside
inline Line lineBetween(const glm::dvec2& from, const glm::dvec2& to, double inwards)
{
  const glm::dvec2 along = glm::normalize(to - from);
  const glm::dvec2 normal = inwards * glm::dvec2(-along.y, along.x);
  return { normal, glm::dot(normal, from) };
}

} // namespace gnomon::test
