#include "plugin/scene/ActorInternals.h"

#include "vtkActor.h"
#include "vtkFollower.h"
#include "vtkLODProp3D.h"
#include "vtkOpenGLActor.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <optional>
#include <typeinfo>

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

struct LodPropAccess : vtkLODProp3D
{
  static const vtkLODProp3DEntry* entries(vtkLODProp3D* prop)
  {
    return prop->*(&LodPropAccess::LODs);
  }
  static int entryCount(vtkLODProp3D* prop) { return prop->*(&LodPropAccess::NumberOfEntries); }
  static int selected(vtkLODProp3D* prop) { return prop->*(&LodPropAccess::SelectedLODIndex); }
};

} // namespace

bool isPlainActor(const vtkProp* prop)
{
  return typeid(*prop) == typeid(vtkOpenGLActor);
}

ActorDrawing actorDrawing(vtkActor* actor, vtkMatrix4x4* matrix, vtkRenderer* renderer)
{
  if (isPlainActor(actor))
  {
    return { actor, actor->GetMapper(), matrix }; // nearly every actor; a cast costs more
  }
  if (auto* follower = vtkFollower::SafeDownCast(actor))
  {
    // An assembly places its parts by PokeMatrix(), which puts a follower of a camera elsewhere. A
    // vtkAxisFollower computes its matrix only while it is drawn.
    const bool served =
      (!follower->GetCamera() || matrix == actor->GetMatrix()) && !actor->IsA("vtkAxisFollower");
    return served ? ActorDrawing{ FollowerAccess::device(follower), actor->GetMapper(), matrix }
                  : ActorDrawing{};
  }
  if (const std::optional<ActorDrawing> levels = drawingOfLevels(actor, matrix, renderer))
  {
    return *levels;
  }
  return { actor, actor->GetMapper(), matrix };
}

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
