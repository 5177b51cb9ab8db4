#include "plugin/scene/SurfaceNames.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_map>

namespace gnomon
{
namespace
{

/// The input of a prop's own mapper, if a surface is made of its polygons or strips as they are.
vtkPolyData* inputOf(vtkProp* prop, const SurfaceKey& key)
{
  auto* const actor = vtkActor::SafeDownCast(prop);
  if (!actor || !actor->GetMapper() || key.glyphPoints || solidOf(key.cells) != Solid::None)
  {
    return nullptr;
  }
  auto* const input = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0));
  return input == key.data ? input : nullptr;
}

} // namespace

std::vector<SurfaceName> surfaceNames(
  vtkRenderer* renderer, const std::vector<SurfaceRecord>& records)
{
  std::unordered_map<const vtkProp*, std::pair<int, vtkProp*>> props;
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* const viewProps = renderer->GetViewProps();
  viewProps->InitTraversal(iterator);
  int number = 0;
  while (vtkProp* const prop = viewProps->GetNextProp(iterator))
  {
    props.emplace(prop, std::pair(number++, prop));
  }
  std::vector<SurfaceName> names;
  names.reserve(records.size());
  std::transform(records.begin(), records.end(), std::back_inserter(names),
    [&](const SurfaceRecord& record)
    {
      const auto found = props.find(record.key.viewProp);
      return found == props.end()
        ? SurfaceName{}
        : SurfaceName{ found->second.first, inputOf(found->second.second, record.key),
            record.key.cells, sharedName(found->second.first, record.key) };
    });
  return names;
}

std::vector<vtkIdType> cellsOfPrimitives(const SurfaceName& name)
{
  std::vector<std::uint32_t> vertexOfPoint;
  std::vector<std::uint32_t> cellOfTriangle;
  triangulate(name.data, name.cells, vertexOfPoint, &cellOfTriangle);
  // A polydata numbers its vertices first, then its lines, polygons and strips.
  const vtkIdType first = name.data->GetNumberOfVerts() + name.data->GetNumberOfLines() +
    (name.cells == SurfaceCells::Strips ? name.data->GetNumberOfPolys() : 0);
  std::vector<vtkIdType> cells(cellOfTriangle.size());
  std::transform(cellOfTriangle.begin(), cellOfTriangle.end(), cells.begin(),
    [first](std::uint32_t cell) { return first + static_cast<vtkIdType>(cell); });
  return cells;
}

} // namespace gnomon
