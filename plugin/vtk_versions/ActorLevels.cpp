#include "plugin/vtk_versions/ActorLevels.h"

#if VTK_MODULE_ENABLE_VTK_RenderingLOD

#include "vtkActor.h"
#include "vtkLODActor.h"
#include "vtkMapperCollection.h"
#include "vtkPolyDataMapper.h"
#include "vtkQuadricLODActor.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace gnomon
{
namespace
{

// Inner actors without getters, as in ActorInternals.cpp.
struct LodActorAccess : vtkLODActor
{
  static vtkActor* device(vtkLODActor* actor) { return actor->*(&LodActorAccess::Device); }
};

struct QuadricAccess : vtkQuadricLODActor
{
  static vtkActor* device(vtkQuadricLODActor* actor) { return actor->*(&QuadricAccess::LODActor); }
  static vtkMapper* coarse(vtkQuadricLODActor* actor)
  {
    return actor->*(&QuadricAccess::LODMapper);
  }
};

/// Return the mapper that a vtkLODActor chooses: a level that was never timed, else the slowest
/// that keeps the time, else the fastest.
vtkMapper* chosenLevel(vtkLODActor* actor)
{
  const auto allowed = static_cast<float>(actor->GetAllocatedRenderTime()); // a float in VTK, too
  vtkMapper* best = actor->GetMapper();
  auto bestTime = static_cast<float>(best->GetTimeToDraw());
  if (bestTime <= allowed)
  {
    return best;
  }
  vtkMapperCollection* levels = actor->GetLODMappers();
  vtkCollectionSimpleIterator cookie;
  levels->InitTraversal(cookie);
  while (vtkMapper* level = levels->GetNextMapper(cookie))
  {
    const auto time = static_cast<float>(level->GetTimeToDraw());
    if (time == 0.0f)
    {
      return level;
    }
    if ((bestTime > allowed && time < bestTime) || (time > bestTime && time < allowed))
    {
      best = level;
      bestTime = time;
    }
  }
  return best;
}

/// Return a vtkQuadricLODActor's drawing. Frames that must be as fast as interaction asks have the
/// coarse level. VTK makes that level in the first of them, which still has the full one.
ActorDrawing quadricDrawing(vtkQuadricLODActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer)
{
  vtkActor* device = QuadricAccess::device(actor);
  vtkRenderWindow* window = renderer->GetRenderWindow();
  vtkRenderWindowInteractor* interactor = window ? window->GetInteractor() : nullptr;
  if (!interactor || device->IsA("vtkFollower"))
  {
    return {}; // VTK needs an interactor here, and treats a follower as a plain actor
  }
  const double rate = std::clamp(interactor->GetDesiredUpdateRate(), 1.0, 75.0);
  vtkMapper* coarse = QuadricAccess::coarse(actor);
  if (actor->GetAllocatedRenderTime() <= 1.1 / rate && coarse->GetNumberOfInputConnections(0) > 0)
  {
    return { device, coarse, device->GetMatrix() }; // VTK does not move the device
  }
  return { device, actor->GetMapper(), matrix };
}

} // namespace

std::optional<ActorDrawing> drawingOfLevels(
  vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer)
{
  if (auto* lodActor = vtkLODActor::SafeDownCast(actor))
  {
    return ActorDrawing{ LodActorAccess::device(lodActor), chosenLevel(lodActor), matrix };
  }
  if (auto* quadric = vtkQuadricLODActor::SafeDownCast(actor))
  {
    return quadricDrawing(quadric, matrix, renderer);
  }
  return std::nullopt;
}

} // namespace gnomon

#else

namespace gnomon
{

std::optional<ActorDrawing> drawingOfLevels(vtkActor*, vtkMatrix4x4*, vtkRenderer*)
{
  return std::nullopt;
}

} // namespace gnomon

#endif
