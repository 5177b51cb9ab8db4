#pragma once

#include "plugin/vtk_versions/CompositeMappers.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkCompositeDataDisplayAttributes;
VTK_ABI_NAMESPACE_END

// The drawers of blocks in VTK's releases, each with the functions that CompositeMappers.h needs.
namespace gnomon
{

#if GNOMON_VTK_HAS_BLOCK_HELPERS
/// True for vtkCompositePolyDataMapper2, which draws blocks by helpers.
bool hasBlockHelpers(vtkMapper* mapper);
vtkCompositeDataDisplayAttributes* looksOfHelpers(vtkMapper* mapper);
std::vector<vtkPolyData*> blocksOfHelpers(vtkActor* actor, vtkMapper* mapper, bool translucent);
std::optional<std::vector<DrawCall>> helperDrawCalls(vtkAbstractMapper* mapper, int primitiveType);
#endif

#if GNOMON_VTK_HAS_BLOCK_BATCHES
/// True for vtkCompositePolyDataMapper if it draws blocks in batches.
bool hasBlockBatches(vtkMapper* mapper);
vtkCompositeDataDisplayAttributes* looksOfBatches(vtkMapper* mapper);
std::vector<vtkPolyData*> blocksOfBatches(vtkActor* actor, vtkMapper* mapper, bool translucent);
std::optional<std::vector<DrawCall>> batchDrawCalls(vtkAbstractMapper* mapper, int primitiveType);
#else
/// True for vtkCompositePolyDataMapper if it has a polydata mapper for each block.
bool hasBlockParts(vtkMapper* mapper);
std::vector<vtkPolyData*> blocksOfParts(vtkMapper* mapper, bool translucent);
#endif

} // namespace gnomon
