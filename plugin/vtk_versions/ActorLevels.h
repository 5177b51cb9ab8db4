#pragma once

#include "lights/vtkGnomonVersions.h"

#include <optional>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkMapper;
class vtkMatrix4x4;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The actor, mapper and matrix of an actor's drawing in this frame.
struct ActorDrawing
{
  vtkActor* actor = nullptr; ///< as VTK hands it to a render pass; null if not supported
  vtkMapper* mapper = nullptr;
  vtkMatrix4x4* matrix = nullptr;
};

/// Return what an actor with levels of detail draws in this frame; nothing for other actors. The
/// VTK of ParaView lacks the module RenderingLOD and its actors.
/// @param matrix of the actor
std::optional<ActorDrawing> drawingOfLevels(
  vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer);

} // namespace gnomon
