#include "shadowtech/base/Instances.h"

#include "shadowtech/base/Occluders.h"

#include <cmath>

namespace gnomon
{
//------------------------------------------------------------------------------
double skewness(const glm::dmat3& linear)
{
  // A singular matrix gives infinity, or NaN where a column is zero.
  return glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]) /
    std::abs(glm::determinant(linear));
}

//------------------------------------------------------------------------------
bool isRegular(const glm::dmat3& linear)
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

//------------------------------------------------------------------------------
Bounds instancesBounds(const glm::vec3* positionsSource, std::size_t vertexCount,
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
