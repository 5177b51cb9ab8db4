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
  Shared, ///< block by block, from buffers that blocks share
  Parts   ///< by one polydata mapper for each block
};
BlockDrawing blockDrawing(vtkMapper* mapper);

/// Return the polydata that a mapper of composite data draws for an actor in the opaque or the
/// translucent pass. Each is listed once, in the order of the tree.
///
/// @param mapper whose blockDrawing() is not None
std::vector<vtkPolyData*> drawnBlocks(vtkActor* actor, vtkMapper* mapper, bool translucent);

/// True if blocks of a mapper of composite data may have other opacities than their actor.
bool mayBlocksDiffer(vtkMapper* mapper);

/// One draw call of a mapper that is about to draw. Its first triangle has the primitive number
/// `firstPrimitive`, as gl_PrimitiveID + PrimitiveIDOffset.
struct DrawCall
{
  vtkPolyData* data = nullptr;
  std::uint32_t firstPrimitive = 0;
};

/// Return the draw calls of the mapper that draws blocks inside one of composite data, in order of
/// firstPrimitive. Nothing for other mappers.
///
/// @param primitiveType vtkOpenGLPolyDataMapper::PrimitiveTris or PrimitiveTriStrips
std::optional<std::vector<DrawCall>> blockDrawCalls(vtkAbstractMapper* mapper, int primitiveType);

} // namespace gnomon
