#include "plugin/vtk_versions/CompositeMappers.h"

#include "plugin/vtk_versions/BlockDrawers.h"

#include "vtkCompositeDataDisplayAttributes.h"

namespace gnomon
{

BlockDrawing blockDrawing(vtkMapper* mapper)
{
#if GNOMON_VTK_HAS_BLOCK_HELPERS
  if (hasBlockHelpers(mapper))
  {
    return BlockDrawing::Shared;
  }
#endif
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  return hasBlockBatches(mapper) ? BlockDrawing::Shared : BlockDrawing::None;
#else
  return hasBlockParts(mapper) ? BlockDrawing::Parts : BlockDrawing::None;
#endif
}

std::vector<vtkPolyData*> drawnBlocks(vtkActor* actor, vtkMapper* mapper, bool translucent)
{
#if GNOMON_VTK_HAS_BLOCK_HELPERS
  if (hasBlockHelpers(mapper))
  {
    return blocksOfHelpers(actor, mapper, translucent);
  }
#endif
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  return blocksOfBatches(actor, mapper, translucent);
#else
  return blocksOfParts(mapper, translucent);
#endif
}

bool mayBlocksDiffer(vtkMapper* mapper)
{
  const auto differ = [](vtkCompositeDataDisplayAttributes* looks)
  { return looks && looks->HasBlockOpacities(); };
#if GNOMON_VTK_HAS_BLOCK_HELPERS
  if (hasBlockHelpers(mapper))
  {
    return differ(looksOfHelpers(mapper));
  }
#endif
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  return differ(looksOfBatches(mapper));
#else
  return true;
#endif
}

std::optional<std::vector<DrawCall>> blockDrawCalls(vtkAbstractMapper* mapper, int primitiveType)
{
  std::optional<std::vector<DrawCall>> calls;
#if GNOMON_VTK_HAS_BLOCK_HELPERS
  calls = helperDrawCalls(mapper, primitiveType);
#endif
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  if (!calls)
  {
    calls = batchDrawCalls(mapper, primitiveType);
  }
#endif
  return calls;
}

} // namespace gnomon
