#include "plugin/scene/SplatSpheres.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon
{
namespace
{

/// Return a component of a tuple; the tuple's length if there is no such component.
double componentOf(vtkDataArray* array, vtkIdType point, int component)
{
  const int count = array->GetNumberOfComponents();
  if (count == 1 || (component >= 0 && component < count))
  {
    return array->GetComponent(point, count == 1 ? 0 : component);
  }
  double square = 0.0;
  for (int i = 0; i < count; ++i)
  {
    square += std::pow(array->GetComponent(point, i), 2.0);
  }
  return std::sqrt(square);
}

/// Return the points at which VTK draws splats: those of vertex cells, or all if there are none.
std::vector<vtkIdType> drawnPoints(vtkPolyData* data)
{
  std::vector<vtkIdType> points;
  vtkCellArray* vertices = data->GetVerts();
  const auto iterator = vtk::TakeSmartPointer(vertices->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* ids;
    iterator->GetCurrentCell(size, ids);
    points.insert(points.end(), ids, ids + size);
  }
  for (vtkIdType i = 0; vertices->GetNumberOfCells() == 0 && i < data->GetNumberOfPoints(); ++i)
  {
    points.push_back(i);
  }
  return points;
}

} // namespace

const char* reasonAgainstSplats(vtkPointGaussianMapper* mapper)
{
  const char* code = mapper->GetSplatShaderCode();
  return mapper->GetEmissive()                ? "its splats glow"
    : mapper->GetScaleFactor() == 0.0         ? "points"
    : mapper->GetOpacityArray()               ? "its splats are blended"
    : mapper->GetNumberOfClippingPlanes() > 0 ? "clipped"
    : !code || !std::strstr(code, "discard")
    ? "its splat shader code (SetSplatShaderCode) discards nothing, so it has no discs"
    : nullptr;
}

std::vector<vtkPolyData*> splatBlocks(vtkPointGaussianMapper* mapper)
{
  std::vector<vtkPolyData*> blocks;
  const auto add = [&](vtkDataObject* object)
  {
    auto* data = vtkPolyData::SafeDownCast(object);
    if (data && data->GetPoints())
    {
      blocks.push_back(data);
    }
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    add(input);
    return blocks;
  }
  const auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    add(iterator->GetCurrentDataObject());
  }
  return blocks;
}

vtkMTimeType sizesTime(vtkMapper* solids)
{
  auto* splats = vtkPointGaussianMapper::SafeDownCast(solids);
  vtkPiecewiseFunction* sizes = splats ? splats->GetScaleFunction() : nullptr;
  return std::max(solids->GetMTime(), sizes ? sizes->GetMTime() : 0);
}

std::vector<SplatSphere> splatSpheres(vtkPointGaussianMapper* mapper, vtkPolyData* data)
{
  const char* name = mapper->GetScaleArray();
  vtkDataArray* sizes = name ? data->GetPointData()->GetArray(name) : nullptr;
  vtkPiecewiseFunction* function = name ? mapper->GetScaleFunction() : nullptr;
  std::vector<SplatSphere> spheres;
  for (const vtkIdType point : drawnPoints(data))
  {
    const double size = sizes ? componentOf(sizes, point, mapper->GetScaleArrayComponent()) : 1.0;
    const double radius = mapper->GetScaleFactor() * (function ? function->GetValue(size) : size);
    spheres.push_back({ point, std::abs(radius) });
  }
  return spheres;
}

} // namespace gnomon
