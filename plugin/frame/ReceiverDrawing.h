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

class PropStamps;

/// Return a hash of the receivers that props in view show, with one camera and snapshot. Each call
/// gives another number if a prop has shaders of a user's own.
/// @param stamps of this frame
std::size_t hashOfShownProps(const vtkRenderState* s, PropStamps& stamps);

/// True if a prop has shaders of a user's own, a mapper that may have some, or shaders to which
/// other render passes add.
bool anyPropHasOwnShaders(const vtkRenderState* s);
/// True if VTK shades a part of a prop by its physically based model.
bool anyPropIsPhysicallyBased(const vtkRenderState* s);

/// True if a part of a prop has shaders of a user's own. They may move vertices by uniforms, whose
/// changes VTK does not time.
bool hasOwnShaders(vtkProp* prop);

/// The parts of a prop that VTK draws by shaders to which render passes add.
enum class ByPasses
{
  All,
  Nothing, ///< annotations and widgets, which do not hand the passes on to their parts
  Some     ///< an assembly of both
};
ByPasses drawnByPasses(vtkProp* prop);
/// True if an assembly of a picture has parts of both kinds.
bool hasPartsOfBothKinds(const vtkRenderState* s);

/// Draw the opaque props by VTK into the target, whose size is set, each with the shaders of one
/// pass alone.
/// @param pass whose shaders write the target's images
/// @param withPoints true if they write points, too
/// @throws TextureMemoryError
void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target);

} // namespace gnomon
