#pragma once

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <initializer_list>
#include <vector>

namespace gnomon::test
{

using Cells = std::vector<std::vector<vtkIdType>>;

inline vtkSmartPointer<vtkPoints> makePoints(
  const std::vector<glm::dvec3>& points, int dataType = VTK_FLOAT)
{
  const auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataType(dataType);
  for (const glm::dvec3& point : points)
  {
    result->InsertNextPoint(point.x, point.y, point.z);
  }
  return result;
}

inline vtkSmartPointer<vtkCellArray> makeCells(const Cells& cells)
{
  const auto result = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<vtkIdType>& cell : cells)
  {
    result->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return result;
}

inline vtkSmartPointer<vtkPolyData> makePolyData(
  const std::vector<glm::dvec3>& points, const Cells& polygons, int dataType = VTK_FLOAT)
{
  const auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(makePoints(points, dataType));
  result->SetPolys(makeCells(polygons));
  return result;
}

/// The unit square in the xy plane, its front towards +z, as one polygon.
inline vtkSmartPointer<vtkPolyData> makeSquare(int dataType = VTK_FLOAT)
{
  return makePolyData(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }, dataType);
}

inline vtkSmartPointer<vtkActor> makeActor(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

} // namespace gnomon::test
