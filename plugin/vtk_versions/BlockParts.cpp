#include "plugin/vtk_versions/BlockDrawers.h"
#include "plugin/vtk_versions/BlockWalk.h"

#if !GNOMON_VTK_HAS_BLOCK_BATCHES

#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkPolyData.h"

#include <unordered_set>

namespace gnomon
{

bool hasBlockParts(vtkMapper* mapper)
{
  return mapper->IsA("vtkCompositePolyDataMapper");
}

/// Return the blocks of one pass. Only the colours determine a polydata's pass: its mapper has a
/// shallow copy of it.
std::vector<vtkPolyData*> blocksOfParts(vtkMapper* mapper, bool translucent)
{
  std::vector<vtkPolyData*> parts;
  const BlockScalars scalars(mapper, false);
  std::unordered_set<vtkPolyData*> seen;
  const auto add = [&](vtkDataObject* object)
  {
    auto* data = vtkPolyData::SafeDownCast(object);
    if (data && scalars.areOpaque(data) != translucent && seen.insert(data).second)
    {
      parts.push_back(data);
    }
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* tree = vtkCompositeDataSet::SafeDownCast(input))
  {
    for (vtkDataObject* leaf : vtk::Range(tree, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      add(leaf);
    }
  }
  else
  {
    add(input);
  }
  return parts;
}

} // namespace gnomon

#endif
