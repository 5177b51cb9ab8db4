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

class PropRecords;

/// Facts about the props in view, from one walk before a pass is named in their keys.
struct ShownProps
{
  /// The same number means that they show the same receivers, with one camera and snapshot. A prop
  /// with shaders of a user's own makes it another number in each frame.
  std::size_t hash = 0;
  /// A prop has shaders of a user's own, a mapper that may have some, or shaders to which other
  /// render passes add.
  bool ownShaders = false;
  bool physicallyBased = false;  ///< VTK shades a part by its physically based model
  bool partsOfBothKinds = false; ///< of an assembly: drawnByPasses() is Some
};
/// @param records of this frame
ShownProps readShownProps(const vtkRenderState* s, PropRecords& records);

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

/// Draw the opaque props by VTK into the target, whose size is set, each with the shaders of one
/// pass alone.
/// @param pass whose shaders write the target's images
/// @param withPoints true if they write points, too
/// @throws TextureMemoryError
void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target);

} // namespace gnomon
