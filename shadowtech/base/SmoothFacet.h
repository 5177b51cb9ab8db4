#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

struct Occluders;
struct Surface;
struct TriangleOfFragment;

/// @file
/// Triangles that VTK shades with the normals of their corners, as if they were curved. Their
/// shading turns dark where the curved surface turns away, but the shadow of a flat triangle ends
/// at its edges. So the *shadow terminator* of a coarse mesh is jagged. Shadow rays that start on
/// the curved surface have no such steps.

/// Coordinates of points, one array for each axis.
struct PointArrays
{
  const float* x;
  const float* y;
  const float* z;
};

/// A triangle with the normals of its corners, in float. Coordinates are relative to its first
/// corner, which keeps the numbers small.
class SmoothFacet
{
public:
  /// @param corners centred
  /// @param normals of the corners, unit length, on the camera's side
  SmoothFacet(const std::array<glm::dvec3, 3>& corners, const std::array<glm::vec3, 3>& normals);

  /// Find the height of the curved surface above points of the triangle, along its normal there.
  /// The height is the barycentric mean of the heights of the corners' tangent planes; a plane
  /// below the point counts as 0. Hanika ("Hacking the Shadow Terminator", Ray Tracing Gems II,
  /// 2021, listing 4-1) moves the point itself. Here it stays, because VTK ends a light's cone
  /// there. A hollow surface has height 0.
  /// @param points centred, on the triangle
  /// @param heights resulting heights, in the unit of the coordinates
  /// @param normals three arrays, set to the means of the corners' normals, unit length
  void look(std::size_t count, const PointArrays& points, float* heights,
    const std::array<float*, 3>& normals) const;

  /// Return the largest height at the centre and the middles of the edges.
  float largestHeight() const;

private:
  glm::vec3 first_; ///< the first corner, centred
  ///@{
  /// For each corner: its barycentric share of a point p is dot(gradient, p), plus 1 for the first
  /// corner. The height of p above its tangent plane is dot(normal, p) + below.
  std::array<glm::vec3, 3> gradients_;
  std::array<glm::vec3, 3> normals_;
  std::array<float, 3> below_;
  ///@}
  std::array<glm::vec3, 3> corners_; ///< relative to the first
};

/// Return the matrix that transforms normals of points that a matrix transforms: its inverse,
/// transposed, times the magnitude of its determinant. So it exists for singular matrices, too.
inline glm::dmat3 normalMatrix(const glm::dmat3& matrix)
{
  const glm::dmat3 cofactors(glm::cross(matrix[1], matrix[2]), glm::cross(matrix[2], matrix[0]),
    glm::cross(matrix[0], matrix[1]));
  return glm::determinant(matrix) < 0.0 ? -cofactors : cofactors;
}

/// Of 42 degrees: a corner's normal farther off its facet implies no curve.
inline constexpr float leastCosineOfCurve = 0.74314483f;

/// Return the normals of a triangle's corners, centred: unit length, on the camera's side.
/// @param normal of the triangle, unit length, on the camera's side
/// @param back true if the camera sees the corners run clockwise
/// @return none if the surface has none, or if one is too far off the triangle's
std::optional<std::array<glm::vec3, 3>> cornerNormals(
  const Occluders& occluders, const TriangleOfFragment& found, const glm::dvec3& normal, bool back);

/// Return the largest height of some triangles; 0 if all are hollow. Maps know this one height of a
/// surface, not which of its triangles are curved. So it is 0, too, if the triangles whose normals
/// imply no curve have more than a hundredth of the others' area: a tube with caps, its normals
/// averaged over the rims. The caps would be lit from behind.
/// @param triangles triangles with a vertex index out of range are skipped
/// @param normals one for each vertex, of any length
float largestHeightOf(const std::vector<glm::vec3>& positions,
  const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec3>& normals);

/// Surfaces with more triangles than this have no facets that are large in a picture.
inline constexpr std::size_t mostFacets = 65536;

/// Return the largest length of a matrix's columns: the most that it scales along an axis.
inline double largestScale(const glm::dmat3& matrix)
{
  return std::max({ glm::length(matrix[0]), glm::length(matrix[1]), glm::length(matrix[2]) });
}

} // namespace gnomon
