#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// Return how far an instance's matrix is from a rotation with scales along orthogonal axes: the
/// product of its columns' lengths over the determinant's magnitude. It is 1 for such a matrix,
/// more for a shear (Hadamard's inequality), infinite for a singular one.
inline double skewness(const glm::dmat3& linear)
{
  // A singular matrix gives infinity, or NaN where a column is zero.
  return glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]) /
    std::abs(glm::determinant(linear));
}

/// The largest skewness of an instance. The bound of ShadowRay.h on the error of Embree's inverse
/// matrix relies on it.
inline constexpr double mostSkewness = 2.0;

/// The range of the lengths of an instance's columns. Within it floats hold the determinant and the
/// inverse at full precision.
inline constexpr double smallestInstanceScale = 9.094947e-13; // 2^-40
inline constexpr double largestInstanceScale = 1.0995116e12;  // 2^40

/// True if floats can transform rays into an instance's own space with an error of at most
/// instanceNoise() (ShadowRay.h).
inline bool isRegular(const glm::dmat3& linear)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double scale = glm::length(linear[axis]);
    if (!(scale >= smallestInstanceScale && scale <= largestInstanceScale)) // NaN fails
    {
      return false;
    }
  }
  return skewness(linear) <= mostSkewness;
}

/// Return the box around all instances of some vertices in source coordinates, without those left
/// out. It is as tight as a box around their triangles, because light views are fitted to it.
inline Bounds instancesBounds(const glm::vec3* positionsSource, std::size_t vertexCount,
  const std::vector<glm::mat4x3>& centredFromSource)
{
  Bounds source;
  for (std::size_t i = 0; i < vertexCount; ++i)
  {
    source.add(glm::dvec3(positionsSource[i]));
  }
  Bounds bounds;
  if (source.empty())
  {
    return bounds;
  }
  const glm::dvec3 half = 0.5 * (source.upper - source.lower);
  for (const glm::mat4x3& instance : centredFromSource)
  {
    if (Surface::isLeftOut(instance))
    {
      continue;
    }
    const glm::dmat4x3 matrix(instance);
    const glm::dvec3 centre = matrix * glm::dvec4(source.centre(), 1.0);
    const glm::dvec3 reach =
      glm::abs(matrix[0]) * half.x + glm::abs(matrix[1]) * half.y + glm::abs(matrix[2]) * half.z;
    // Most instances lie within the box so far, by the box around the image of their source's box.
    Bounds extended = bounds;
    extended.add(centre - reach);
    extended.add(centre + reach);
    if (extended.lower == bounds.lower && extended.upper == bounds.upper)
    {
      continue;
    }
    for (std::size_t i = 0; i < vertexCount; ++i)
    {
      bounds.add(matrix * glm::dvec4(glm::dvec3(positionsSource[i]), 1.0));
    }
  }
  return bounds;
}

} // namespace gnomon
