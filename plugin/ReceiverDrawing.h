#ifndef gnomon_plugin_ReceiverDrawing_h
#define gnomon_plugin_ReceiverDrawing_h

#include "lights/CameraView.h"
#include "shadowtech/base/ReceiverTarget.h"

#include <glm/glm.hpp>

#include <cstddef>

class vtkObjectBase;
class vtkRenderState;

namespace gnomon
{

/// What a picture of receivers depends on, beside their places in the snapshot: the same numbers mean the same picture.
std::size_t hashOfReceivers(
  const vtkRenderState* s, const CameraView& camera, const glm::ivec2& size);

/// Has VTK draw the opaque props into the target, whose size is set, each with the shaders of one pass alone.
/// @param pass whose shaders write what the target takes
/// @param withPoints whether that is points, too
/// @throws TextureMemoryError
void drawReceivers(const vtkRenderState* s, vtkObjectBase* pass, const glm::ivec2& size,
  bool withPoints, ReceiverTarget& target);

} // namespace gnomon

#endif
