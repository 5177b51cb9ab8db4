#pragma once

#include "plugin/Shapes.h"

#include "vtkActor.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace gnomon::test
{

using Cells = std::vector<std::vector<vtkIdType>>;

inline vtkSmartPointer<vtkCellArray> makeCells(const Cells& cells)
{
  return meshOf({}, cells)->GetPolys();
}

/// The unit square in the xy plane, its front towards +z, as one polygon.
inline vtkSmartPointer<vtkPolyData> makeSquare(int dataType = VTK_FLOAT)
{
  return meshOf(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }, dataType);
}

inline vtkSmartPointer<vtkActor> makeActor(vtkPolyData* data)
{
  return actorOf(mapperOf(data));
}

} // namespace gnomon::test
