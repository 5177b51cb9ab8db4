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
/// Triangles that are shaded with the normals of their corners, as if they were curved. Their light
/// ends where the curved surface turns away, but the shadow of a flat triangle ends at its edges:
/// the *shadow terminator* of a coarse mesh is jagged. Shadow rays that start on the curved surface
/// have no such steps.

/// Coordinates of points, one array for each axis.
struct PointArrays
{
  const float* x;
  const float* y;
  const float* z;
};

/// A triangle with the normals of its corners, in float and relative to its first corner: there
/// the numbers are small.
class SmoothFacet
{
public:
  /// @param corners centred
  /// @param normals of the corners, unit length, on the camera's side
  SmoothFacet(const std::array<glm::dvec3, 3>& corners, const std::array<glm::vec3, 3>& normals);

  /// How high the curved surface is above points of the triangle, along its normal there: the mean,
  /// by barycentric coordinates, of the heights of the corners' tangent planes, where one below the
  /// point counts as 0. Hanika ("Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, listing
  /// 4-1) moves the point itself; here it stays, since VTK ends a light's cone there. A hollow
  /// surface has height 0.
  /// @param points centred
  /// @param normals three arrays; get the means of the corners' normals, unit length
  void look(std::size_t count, const PointArrays& points, float* heights,
    const std::array<float*, 3>& normals) const;

  /// How high it is: at its centre and in the middles of its edges, at most.
  float largestHeight() const;

private:
  glm::vec3 first_; ///< the first corner, centred
  ///@{
  /// For each corner: its share of a point p is dot(gradient, p) + the share at the first corner,
  /// and dot(normal, p) + below is how far above its tangent plane p is.
  std::array<glm::vec3, 3> gradients_;
  std::array<glm::vec3, 3> normals_;
  std::array<float, 3> below_;
  ///@}
  std::array<glm::vec3, 3> corners_; ///< relative
};

/// What takes normals along with points that a matrix takes: its inverse, transposed, times the
/// size of its determinant, so that it is there for every matrix.
inline glm::dmat3 normalMatrix(const glm::dmat3& matrix)
{
  const glm::dmat3 cofactors(glm::cross(matrix[1], matrix[2]), glm::cross(matrix[2], matrix[0]),
    glm::cross(matrix[0], matrix[1]));
  return glm::determinant(matrix) < 0.0 ? -cofactors : cofactors;
}

/// The normals of a triangle's corners, centred: unit length, on the camera's side.
/// @param normal of the triangle, unit length, on the camera's side
/// @param back whether the camera sees the side from which the corners run clockwise
/// @return none where the surface has none, or where one is more than 80 degrees off the triangle's
std::optional<std::array<glm::vec3, 3>> cornerNormals(
  const Occluders& occluders, const TriangleOfFragment& found, const glm::dvec3& normal, bool back);

/// The largest height of some triangles; 0 where all are hollow.
/// @param triangles those with a vertex that is not there do not count
/// @param normals one for each vertex, of any length
float largestHeightOf(const std::vector<glm::vec3>& positions,
  const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec3>& normals);

/// Of more triangles than these each is small in any picture.
inline constexpr std::size_t mostFacets = 65536;

/// How much a matrix makes of what has length 1 along an axis, at most.
inline double largestScale(const glm::dmat3& matrix)
{
  return std::max({ glm::length(matrix[0]), glm::length(matrix[1]), glm::length(matrix[2]) });
}

} // namespace gnomon
