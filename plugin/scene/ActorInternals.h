#pragma once

#include "lights/vtkGnomonVersions.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkLODProp3D;
class vtkMapper;
class vtkMatrix4x4;
class vtkProp3D;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// What an actor draws in this frame.
struct ActorDrawing
{
  vtkActor* actor = nullptr; ///< whom VTK hands to a render pass; null for an actor not served
  vtkMapper* mapper = nullptr;
  vtkMatrix4x4* matrix = nullptr;
};

/// Looks through actors that draw by way of one of their own: followers, and the actors with levels
/// of detail, whose level for this frame is found as they will find it, from the time that the
/// renderer has allocated to them.
///
/// @param matrix the actor's, or that of its path below an assembly
ActorDrawing actorDrawing(vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer);

/// The level that a vtkLODProp3D draws in this frame. For one that chooses by itself and was never
/// in view, the best of its levels; null if it has none.
vtkProp3D* selectedLevel(vtkLODProp3D* prop);

} // namespace gnomon
