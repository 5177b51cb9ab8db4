#include "plugin/scene/ActorInternals.h"

#include "vtkActor.h"
#include "vtkFollower.h"
#include "vtkLODActor.h"
#include "vtkLODProp3D.h"
#include "vtkMapperCollection.h"
#include "vtkPolyDataMapper.h"
#include "vtkQuadricLODActor.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cstring>

namespace gnomon
{
namespace
{

// These actors draw by inner actors without getters, so their protected members are read. Naming
// a member through a subclass gives access to it without a cast.
struct FollowerAccess : vtkFollower
{
  static vtkActor* device(vtkFollower* follower) { return follower->*(&FollowerAccess::Device); }
};

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

struct LodPropAccess : vtkLODProp3D
{
  static const vtkLODProp3DEntry* entries(vtkLODProp3D* prop)
  {
    return prop->*(&LodPropAccess::LODs);
  }
  static int entryCount(vtkLODProp3D* prop) { return prop->*(&LodPropAccess::NumberOfEntries); }
  static int selected(vtkLODProp3D* prop) { return prop->*(&LodPropAccess::SelectedLODIndex); }
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

//------------------------------------------------------------------------------
ActorDrawing actorDrawing(vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer)
{
  if (std::strcmp(actor->GetClassName(), "vtkOpenGLActor") == 0)
  {
    return { actor, actor->GetMapper(), matrix }; // nearly every actor; a cast costs more
  }
  if (auto* follower = vtkFollower::SafeDownCast(actor))
  {
    // An assembly places its parts by PokeMatrix(), which puts a follower elsewhere. A
    // vtkAxisFollower computes its matrix only while it is drawn.
    const bool served = matrix == actor->GetMatrix() && !actor->IsA("vtkAxisFollower");
    return served ? ActorDrawing{ FollowerAccess::device(follower), actor->GetMapper(), matrix }
                  : ActorDrawing{};
  }
  if (auto* lodActor = vtkLODActor::SafeDownCast(actor))
  {
    return { LodActorAccess::device(lodActor), chosenLevel(lodActor), matrix };
  }
  if (auto* quadric = vtkQuadricLODActor::SafeDownCast(actor))
  {
    return quadricDrawing(quadric, matrix, renderer);
  }
  return { actor, actor->GetMapper(), matrix };
}

//------------------------------------------------------------------------------
vtkProp3D* selectedLevel(vtkLODProp3D* prop)
{
  const vtkLODProp3DEntry* first = LodPropAccess::entries(prop);
  const vtkLODProp3DEntry* last = first + LodPropAccess::entryCount(prop);
  constexpr int notInUse = -1;
  if (!prop->GetAutomaticLODSelection())
  {
    // VTK looks up the ID only for props in view, but props out of view cast, too.
    const vtkLODProp3DEntry* const chosen = std::find_if(first, last,
      [prop](const vtkLODProp3DEntry& entry)
      { return entry.ID != notInUse && entry.ID == prop->GetSelectedLODID(); });
    if (chosen != last)
    {
      return chosen->Prop3D;
    }
  }
  const int selected = LodPropAccess::selected(prop);
  if (selected >= 0 && selected < last - first && first[selected].ID != notInUse)
  {
    return first[selected].Prop3D;
  }
  const vtkLODProp3DEntry* best = nullptr;
  for (const vtkLODProp3DEntry* entry = first; entry != last; ++entry)
  {
    const bool enabled = entry->ID != notInUse && entry->State == 1;
    if (enabled && (!best || entry->Level < best->Level)) // level 0 is the best
    {
      best = entry;
    }
  }
  return best ? best->Prop3D : nullptr;
}

} // namespace gnomon
