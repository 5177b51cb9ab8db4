#include "plugin/vtk_versions/BlockDrawers.h"
#include "plugin/vtk_versions/BlockWalk.h"

#if GNOMON_VTK_HAS_BLOCK_HELPERS

// vtkCompositeMapperHelper2.h needs these two but does not include them.
#include "vtkColor.h"
#include GNOMON_VTK_GL_HEADER

// VTK 9.3 and 9.4 have these classes, marked as deprecated.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

#include "vtkCompositeMapperHelper2.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkOpenGLCellToVTKCellMap.h"

#include <map>

namespace gnomon
{
namespace
{

// VTK tells a render pass neither which blocks a helper draws nor the first numbers of their
// primitives, so its own member is read. Naming it through a subclass gives access without a cast.
struct HelperAccess : vtkCompositeMapperHelper2
{
  using Blocks = std::map<vtkPolyData*, vtkCompositeMapperHelperData*>;
  static const Blocks& blocks(vtkCompositeMapperHelper2* helper)
  {
    return helper->*(&HelperAccess::Data);
  }
};

} // namespace

bool hasBlockHelpers(vtkMapper* mapper)
{
  return mapper->IsA("vtkCompositePolyDataMapper2");
}

vtkCompositeDataDisplayAttributes* looksOfHelpers(vtkMapper* mapper)
{
  return static_cast<vtkCompositePolyDataMapper2*>(mapper)->GetCompositeDataDisplayAttributes();
}

std::vector<vtkPolyData*> blocksOfHelpers(vtkActor* actor, vtkMapper* mapper, bool translucent)
{
  const BlockWalk walk(actor, mapper, looksOfHelpers(mapper), false);
  return walk.drawn(translucent);
}

std::optional<std::vector<DrawCall>> helperDrawCalls(vtkAbstractMapper* mapper, int primitiveType)
{
  auto* helper = vtkCompositeMapperHelper2::SafeDownCast(mapper);
  if (!helper)
  {
    return std::nullopt;
  }
  std::vector<DrawCall> calls;
  for (const auto& [data, block] : HelperAccess::blocks(helper))
  {
    const vtkIdType offset = block->CellCellMap->GetPrimitiveOffsets()[primitiveType];
    calls.push_back({ data, static_cast<std::uint32_t>(offset) });
  }
  return calls;
}

} // namespace gnomon

#endif
