#include "plugin/vtk_versions/BlockDrawers.h"
#include "plugin/vtk_versions/BlockWalk.h"

#if GNOMON_VTK_HAS_BLOCK_BATCHES

#include "vtkCompositePolyDataMapper.h"
#include "vtkOpenGLBatchedPolyDataMapper.h"
#include "vtkOpenGLCellToVTKCellMap.h"

#include <algorithm>
#include <iterator>

namespace gnomon
{
namespace
{

// VTK tells a render pass neither which blocks a batch draws nor the first numbers of their
// primitives, so its own members are read. Naming them through a subclass gives access without a
// cast.
struct BatchAccess : vtkOpenGLBatchedPolyDataMapper
{
  static const auto& blocks(vtkOpenGLBatchedPolyDataMapper* batch)
  {
    return batch->*(&BatchAccess::VTKPolyDataToGLBatchElement);
  }
  static bool hasEdges(vtkOpenGLBatchedPolyDataMapper* batch)
  {
    return !(batch->*(&BatchAccess::EdgeValues)).empty();
  }
};

/// Give the blocks of a batch separate primitive numbers. Until 9.4 VTK counts them through the
/// blocks. Later it counts cell colours or edges alone: blocks without these start at one number,
/// and no pixel can tell its block. VTK reads the starts for each draw call, and hardware selection
/// applies them in reverse.
void separateNumbers(vtkOpenGLBatchedPolyDataMapper* batch)
{
  if (BatchAccess::hasEdges(batch))
  {
    return; // the numbers are separate, and index a texture
  }
  vtkIdType next = 0;
  for (const auto& [address, block] : BatchAccess::blocks(batch))
  {
    vtkOpenGLCellToVTKCellMap* numbers = block->CellCellMap;
    if (numbers->GetPrimitiveOffsets()[0] < next)
    {
      numbers->SetStartOffset(next);
    }
    next = numbers->GetFinalOffset();
  }
}

} // namespace

bool hasBlockBatches(vtkMapper* mapper)
{
  return mapper->IsA("vtkCompositePolyDataMapper");
}

vtkCompositeDataDisplayAttributes* looksOfBatches(vtkMapper* mapper)
{
  return static_cast<vtkCompositePolyDataMapper*>(mapper)->GetCompositeDataDisplayAttributes();
}

std::vector<vtkPolyData*> blocksOfBatches(vtkActor* actor, vtkMapper* mapper, bool translucent)
{
  const BlockWalk walk(actor, mapper, looksOfBatches(mapper), true);
  return walk.drawn(translucent);
}

std::optional<std::vector<DrawCall>> batchDrawCalls(vtkAbstractMapper* mapper, int primitiveType)
{
  auto* batch = vtkOpenGLBatchedPolyDataMapper::SafeDownCast(mapper);
  if (!batch)
  {
    return std::nullopt;
  }
  separateNumbers(batch);
  const auto& blocks = BatchAccess::blocks(batch);
  std::vector<DrawCall> calls;
  std::transform(blocks.begin(), blocks.end(), std::back_inserter(calls),
    [primitiveType](const auto& block)
    {
      const vtkIdType first = block.second->CellCellMap->GetPrimitiveOffsets()[primitiveType];
      return DrawCall{ block.second->Parent.PolyData, static_cast<std::uint32_t>(first) };
    });
  return calls;
}

} // namespace gnomon

#endif
