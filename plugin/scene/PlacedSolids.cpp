#include "plugin/scene/PlacedSolids.h"

#include "shadowtech/base/Occluders.h"

#include "vtkFloatArray.h"
#include "vtkPolyData.h"

#include <cmath>
#include <cstddef>

namespace gnomon
{
namespace
{

glm::dvec3 tupleOf(vtkFloatArray* array, vtkIdType point)
{
  double tuple[3];
  array->GetTuple(point, tuple);
  return { tuple[0], tuple[1], tuple[2] };
}

/// A matrix that turns the z axis to a vector's direction, with the columns across of this length.
glm::dmat3 alongAxis(const glm::dvec3& halfAxis, double radius)
{
  const glm::dvec3 axis = glm::normalize(halfAxis);
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(axis, other));
  return { radius * x, radius * glm::cross(axis, x), halfAxis };
}

/// What takes the unit solid to a point's, but for its place.
glm::dmat3 linearOf(const DrawnSolids& drawn, const glm::dmat3& turn, vtkIdType point)
{
  if (drawn.cells == SurfaceCells::Spheres)
  {
    return glm::dmat3(drawn.scales ? drawn.scales->GetValue(point) : drawn.radius);
  }
  const glm::dvec3 size = tupleOf(drawn.scales, point); // length, radius
  return alongAxis(turn * (0.5 * size.x * tupleOf(drawn.directions, point)), size.y);
}

/// Of numbers that are not finite, the sum is not either.
bool hasFiniteNumbers(const glm::mat4x3& matrix)
{
  const glm::dvec3 sum = glm::dmat4x3(matrix) * glm::dvec4(1.0);
  return std::isfinite(sum.x + sum.y + sum.z);
}

bool hasSize(const glm::mat4x3& matrix)
{
  return glm::determinant(glm::dmat3(matrix[0], matrix[1], matrix[2])) > 0.0;
}

} // namespace

//------------------------------------------------------------------------------
PlacedInstances placeSolids(const DrawnSolids& drawn, vtkPolyData* data,
  const glm::dmat4& worldFromModel, const glm::dvec3& centreWorld)
{
  PlacedInstances placed;
  const vtkIdType count = data->GetNumberOfPoints();
  placed.centredFromSource.reserve(static_cast<std::size_t>(count));
  for (vtkIdType point = 0; point < count; ++point)
  {
    glm::dvec3 model;
    data->GetPoint(point, &model.x);
    const glm::dvec4 world = worldFromModel * glm::dvec4(model, 1.0);
    glm::dmat4x3 matrix(linearOf(drawn, glm::dmat3(worldFromModel), point));
    matrix[3] = glm::dvec3(world) / world.w - centreWorld;
    const glm::mat4x3 rounded(matrix);
    const bool finite = hasFiniteNumbers(rounded);
    const bool kept = finite && hasSize(rounded);
    placed.leftOutNonFinite += finite ? 0 : 1;
    placed.leftOutVanished += finite && !kept ? 1 : 0;
    placed.centredFromSource.push_back(kept ? rounded : glm::mat4x3(0.0f));
  }
  return placed;
}

//------------------------------------------------------------------------------
Bounds boundsOfSolids(const DrawnSolids& drawn, vtkPolyData* data)
{
  return solidsBounds(solidOf(drawn.cells),
    placeSolids(drawn, data, glm::dmat4(1.0), glm::dvec3(0.0)).centredFromSource);
}

} // namespace gnomon
