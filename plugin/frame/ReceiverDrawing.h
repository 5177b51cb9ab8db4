#pragma once

#include "lights/vtkGnomonVersions.h"

#include "shadowtech/base/ReceiverTarget.h"

#include <glm/glm.hpp>

#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN
class vtkObjectBase;
class vtkProp;
class vtkRenderState;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// What props in view show of themselves as receivers: the same number means the same, by one
/// camera and snapshot. No two numbers are the same where a prop has shaders of a user's own.
std::size_t hashOfShownProps(const vtkRenderState* s);

/// Whether a prop has shaders of a user's own, a mapper that may have some, or shaders that other
/// render passes add to.
bool anyPropHasOwnShaders(const vtkRenderState* s);

/// Whether a part of a prop has shaders of a user's own: they may move vertices by uniforms whose
/// changes VTK does not time.
bool hasOwnShaders(vtkProp* prop);

/// What of a prop VTK draws by shaders that render passes add to.
enum class ByPasses
{
  All,
  Nothing, ///< annotations and widgets, whose parts VTK does not tell of the passes
  Some     ///< an assembly of both
};
ByPasses drawnByPasses(vtkProp* prop);
/// Whether that holds for all parts of all props of a picture.
bool drawnByPassesAlone(const vtkRenderState* s);

/// Has VTK draw the opaque props into the target, whose size is set, each with the shaders of one
/// pass alone.
/// @param pass whose shaders write what the target takes
/// @param withPoints whether that is points, too
/// @throws TextureMemoryError
void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target);

/// Has VTK draw the opaque props that shaders of render passes draw (ByPasses::All).
void drawOpaque(const vtkRenderState* s);

} // namespace gnomon
