#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/vtk_versions/ActorLevels.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkLODProp3D;
class vtkMatrix4x4;
class vtkProp;
class vtkProp3D;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// True for nearly every prop: an actor of VTK's usual class, which is its own only part. IsA() and
/// casts compare with all base classes, which costs more.
bool isPlainActor(const vtkProp* prop);

/// Return an actor's drawing, also for actors that draw by inner actors: followers and actors with
/// levels of detail. The level is the one that VTK will choose in this frame, from the time that
/// the renderer has allocated to the actor.
///
/// @param matrix the actor's, or that of its path below an assembly
ActorDrawing actorDrawing(vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer);

/// Return the level that a vtkLODProp3D draws in this frame; null if it has none. A prop that
/// chooses by itself and was never in view has its best level.
vtkProp3D* selectedLevel(vtkLODProp3D* prop);

} // namespace gnomon
