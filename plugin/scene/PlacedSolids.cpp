#include "plugin/scene/PlacedSolids.h"

#include "lights/LightSpace.h"
#include "plugin/scene/MapperInternals.h"
#include "plugin/scene/SplatSpheres.h"
#include "shadowtech/base/Occluders.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkFloatArray.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

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

/// Return a matrix that maps z to `halfAxis`, and x and y to vectors of length `radius` across it.
glm::dmat3 alongAxis(const glm::dvec3& halfAxis, double radius)
{
  const glm::dvec3 axis = glm::normalize(halfAxis);
  const glm::dvec3 x = glm::normalize(glm::cross(axis, axisAcross(axis)));
  return { radius * x, radius * glm::cross(axis, x), halfAxis };
}

/// Return the linear part of the matrix from a mapper's unit solid to a point's solid.
glm::dmat3 linearOf(const DrawnSolids& drawn, const glm::dmat3& turn, vtkIdType point)
{
  if (drawn.cells == SurfaceCells::Spheres)
  {
    return glm::dmat3(drawn.scales ? drawn.scales->GetValue(point) : drawn.radius);
  }
  const glm::dvec3 size = tupleOf(drawn.scales, point); // length, radius
  return alongAxis(turn * (0.5 * size.x * tupleOf(drawn.directions, point)), size.y);
}

/// The points of a block in world coordinates.
class WorldPoints
{
public:
  WorldPoints(vtkPolyData* data, const glm::dmat4& worldFromModel)
    : data_(data)
    , worldFromModel_(worldFromModel)
  {
  }
  /// Return a point's position; NaN for a missing point.
  glm::dvec3 operator[](vtkIdType point) const
  {
    glm::dvec3 model(std::numeric_limits<double>::quiet_NaN());
    if (point >= 0 && point < this->data_->GetNumberOfPoints())
    {
      this->data_->GetPoint(point, &model.x);
    }
    const glm::dvec4 world = this->worldFromModel_ * glm::dvec4(model, 1.0);
    return glm::dvec3(world) / world.w;
  }

private:
  vtkPolyData* data_;
  const glm::dmat4& worldFromModel_;
};

/// Return a unit solid's matrix to its place.
glm::dmat4x3 placed(const glm::dmat3& linear, const glm::dvec3& middle)
{
  return { linear[0], linear[1], linear[2], middle };
}

/// Call visit(matrix to the world) for each solid of a mapper of solids.
template <typename Visit>
void visitMapperSolids(
  const DrawnBlock& block, const glm::dmat4& worldFromModel, const Visit& visit)
{
  const WorldPoints points(block.data, worldFromModel);
  const DrawnSolids drawn = *drawnSolids(block.solids);
  for (vtkIdType point = 0; point < block.data->GetNumberOfPoints(); ++point)
  {
    visit(placed(linearOf(drawn, glm::dmat3(worldFromModel), point), points[point]));
  }
}

/// Call visit(matrix to the world) for each sphere that a mapper's splats show.
template <typename Visit>
void visitSplats(const DrawnBlock& block, const glm::dmat4& worldFromModel, const Visit& visit)
{
  const WorldPoints points(block.data, worldFromModel);
  auto* mapper = static_cast<vtkPointGaussianMapper*>(block.solids);
  for (const SplatSphere& sphere : splatSpheres(mapper, block.data))
  {
    visit(placed(glm::dmat3(sphere.radius), points[sphere.point]));
  }
}

/// Call visit(matrix to the world) for each solid that is sized in pixels.
template <typename Visit>
void visitPixelSolids(
  const DrawnBlock& block, SurfaceCells cells, const glm::dmat4& worldFromModel, const Visit& visit)
{
  const WorldPoints points(block.data, worldFromModel);
  const glm::dvec4 radius = radiusFromWorld(block, cells);
  // Behind the camera the radius is 0.
  const auto radiusAt = [&](const glm::dvec3& world)
  { return std::max(0.0, glm::dot(radius, glm::dvec4(world, 1.0))); };
  const bool spheres = cells == SurfaceCells::PointSpheres;
  vtkCellArray* array = spheres ? block.data->GetVerts() : block.data->GetLines();
  const auto iterator = vtk::TakeSmartPointer(array->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    for (vtkIdType i = spheres ? 0 : 1; i < size; ++i)
    {
      const glm::dvec3 end = points[ids[i]];
      const glm::dvec3 start = spheres ? end : points[ids[i - 1]];
      const glm::dvec3 middle = 0.5 * (start + end);
      visit(placed(
        spheres ? glm::dmat3(radiusAt(middle)) : alongAxis(0.5 * (end - start), radiusAt(middle)),
        middle));
    }
  }
}

bool isKept(const std::vector<glm::dvec4>& clipPlanes, const glm::dvec3& world)
{
  return std::all_of(clipPlanes.begin(), clipPlanes.end(),
    [&](const glm::dvec4& plane) { return glm::dot(plane, glm::dvec4(world, 1.0)) >= 0.0; });
}

bool isInWorld(const glm::dmat4x3& solid)
{
  return isWithin(glm::abs(solid[0]) + glm::abs(solid[1]) + glm::abs(solid[2]) + glm::abs(solid[3]),
    largestOfWorld);
}

bool hasSize(const glm::mat4x3& matrix)
{
  return glm::determinant(glm::dmat3(matrix[0], matrix[1], matrix[2])) > 0.0;
}

} // namespace

PlacedInstances placeSolids(const DrawnBlock& block, SurfaceCells cells,
  const glm::dmat4& worldFromModel, const std::vector<glm::dvec4>& clipPlanes,
  const SceneFrame& frame)
{
  PlacedInstances result;
  result.centredFromSource.reserve(static_cast<std::size_t>(cellCount(block.data, cells)));
  const auto add = [&](const glm::dmat4x3& matrix)
  {
    const bool isInside = isKept(clipPlanes, matrix[3]);
    const bool finite = isInWorld(matrix);
    const glm::mat4x3 rounded(frame.centredFrom(glm::dmat4(matrix)));
    const bool kept = finite && isInside && hasSize(rounded);
    result.leftOutNonFinite += finite ? 0 : 1;
    // Solids cut off by a plane or behind the camera are no fault of the data.
    const bool isFault = isInside && !areSizedInPixels(cells);
    result.leftOutVanished += finite && !kept && isFault ? 1 : 0;
    result.centredFromSource.push_back(kept ? rounded : glm::mat4x3(0.0f));
  };
  if (areSizedInPixels(cells))
  {
    visitPixelSolids(block, cells, worldFromModel, add);
  }
  else if (block.solids->IsA("vtkPointGaussianMapper"))
  {
    visitSplats(block, worldFromModel, add);
  }
  else
  {
    visitMapperSolids(block, worldFromModel, add);
  }
  return result;
}

Bounds boundsOfSolids(const DrawnBlock& block, SurfaceCells cells)
{
  if (!areSizedInPixels(cells))
  {
    return solidsBounds(solidOf(cells),
      placeSolids(block, cells, glm::dmat4(1.0), {}, SceneFrame()).centredFromSource);
  }
  Bounds bounds;
  visitPixelSolids(block, cells, glm::dmat4(1.0),
    [&bounds](const glm::dmat4x3& matrix)
    {
      if (isWithin(matrix[3], largestOfWorld))
      {
        bounds.add(matrix[3]);
      }
    });
  return bounds;
}

} // namespace gnomon
