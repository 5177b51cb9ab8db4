#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstdint>
#include <optional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkActor;
class vtkMapper;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// How a mapper draws the polydata of a composite data set.
enum class BlockDrawing
{
  None,   ///< it draws no composite data sets
  Shared, ///< block by block, out of buffers that blocks share
  Parts   ///< by one polydata mapper a block
};
BlockDrawing blockDrawing(vtkMapper* mapper);

/// The polydata that a mapper of composite data draws for an actor, each one once, in the order of
/// the tree: what the opaque pass draws, or what the translucent pass draws.
///
/// @param mapper whose blockDrawing() is not None
std::vector<vtkPolyData*> drawnBlocks(vtkActor* actor, vtkMapper* mapper, bool translucent);

/// One draw call of a mapper that is about to draw: the first of its triangles has the primitive
/// number `firstPrimitive`, by gl_PrimitiveID + PrimitiveIDOffset.
struct DrawCall
{
  vtkPolyData* data = nullptr;
  std::uint32_t firstPrimitive = 0;
};

/// The draw calls of the mapper that draws blocks inside one of composite data, in order of
/// firstPrimitive; nothing for any other mapper.
///
/// @param primitiveType vtkOpenGLPolyDataMapper::PrimitiveTris or PrimitiveTriStrips
std::optional<std::vector<DrawCall>> blockDrawCalls(vtkAbstractMapper* mapper, int primitiveType);

} // namespace gnomon
