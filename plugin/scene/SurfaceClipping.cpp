#include "plugin/scene/SurfaceClipping.h"

#include "plugin/scene/SurfaceExtraction.h"

#include "shadowtech/base/Occluders.h"

#include <algorithm>
#include <numeric>

namespace gnomon
{
namespace
{

/// A polygon's corner, with quantities that are affine on the polygon.
struct Corner
{
  glm::dvec3 position;
  glm::dvec2 textureCoordinates;
};
using Polygon = std::vector<Corner>;

double distance(const glm::dvec4& plane, const Corner& corner)
{
  return glm::dot(glm::dvec3(plane), corner.position) + plane.w;
}

/// Return where the edge from a point inside a plane to one outside meets it. It is always computed
/// from the inside, so triangles that share an edge are cut at the same point.
Corner cut(const glm::dvec4& plane, const Corner& inside, const Corner& outside)
{
  const double in = distance(plane, inside);
  const double out = distance(plane, outside); // out < 0 <= in, so they differ
  const double share = in / (in - out);
  return { inside.position + (outside.position - inside.position) * share,
    inside.textureCoordinates + (outside.textureCoordinates - inside.textureCoordinates) * share };
}

/// Return the part of a convex polygon inside a plane (Sutherland and Hodgman).
Polygon clip(const Polygon& polygon, const glm::dvec4& plane)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const bool fromInside = distance(plane, from) >= 0.0;
    const bool toInside = distance(plane, to) >= 0.0;
    if (fromInside)
    {
      result.push_back(from);
    }
    if (fromInside != toInside)
    {
      result.push_back(fromInside ? cut(plane, from, to) : cut(plane, to, from));
    }
  }
  return result;
}

} // namespace

void clipTriangles(const std::vector<glm::dvec4>& planes, std::vector<glm::vec3>& positions,
  std::vector<glm::vec2>& textureCoordinates, std::vector<glm::uvec3>& triangles,
  std::vector<std::uint32_t>& triangleOfDrawn)
{
  const bool textured = !textureCoordinates.empty();
  std::vector<glm::uvec3> pieces;
  std::vector<std::uint32_t> firstPiece(triangles.size(), Surface::noTriangle);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const glm::uvec3 triangle = triangles[i];
    Polygon polygon;
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::uint32_t vertex = triangle[corner];
      polygon.push_back({ glm::dvec3(positions[vertex]),
        textured ? glm::dvec2(textureCoordinates[vertex]) : glm::dvec2(0.0) });
    }
    const bool whole = std::all_of(planes.begin(), planes.end(),
      [&polygon](const glm::dvec4& plane)
      {
        return std::all_of(polygon.begin(), polygon.end(),
          [&plane](const Corner& corner) { return distance(plane, corner) >= 0.0; });
      });
    const auto first = static_cast<std::uint32_t>(pieces.size());
    if (whole)
    {
      pieces.push_back(triangle);
    }
    else
    {
      for (const glm::dvec4& plane : planes)
      {
        polygon = clip(polygon, plane);
      }
      const auto firstVertex = static_cast<std::uint32_t>(positions.size());
      for (const Corner& corner : polygon)
      {
        positions.emplace_back(corner.position);
        if (textured)
        {
          textureCoordinates.emplace_back(corner.textureCoordinates);
        }
      }
      for (std::uint32_t corner = 2; corner < polygon.size(); ++corner)
      {
        const glm::uvec3 piece = firstVertex + glm::uvec3(0, corner - 1, corner);
        if (defectOf(piece, positions.data()) == Defect::None)
        {
          pieces.push_back(piece);
        }
      }
    }
    if (pieces.size() > first)
    {
      firstPiece[i] = first;
    }
  }

  if (triangleOfDrawn.empty())
  {
    triangleOfDrawn.resize(triangles.size());
    std::iota(triangleOfDrawn.begin(), triangleOfDrawn.end(), 0u);
  }
  for (std::uint32_t& triangle : triangleOfDrawn)
  {
    triangle = triangle == Surface::noTriangle ? triangle : firstPiece[triangle];
  }
  triangles = std::move(pieces);
}

} // namespace gnomon
