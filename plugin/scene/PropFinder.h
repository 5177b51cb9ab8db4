#pragma once

#include "plugin/scene/DrawnBlocks.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/PropMemory.h"
#include "plugin/scene/PropNotes.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>

class vtkActor;
class vtkMapper;
class vtkMatrix4x4;
class vtkObjectBase;
class vtkProp;
class vtkRenderer;

namespace gnomon
{

/// Finds what is drawn: a walk over the props of a renderer.
class PropFinder
{
public:
  PropFinder(vtkRenderer* renderer, PropMemory& memory, TranslucentRole translucent);
  /// @param number of the prop in vtkRenderer::GetViewProps()
  void addViewProp(vtkProp* viewProp, int number);
  DrawnProps take();

private:
  /// The way to take leaves of a class. Without a function or reason, no note tells of them.
  struct LeafKind
  {
    const char* name;
    void (PropFinder::*add)(vtkProp* leaf, vtkMatrix4x4* matrix) = nullptr;
    const char* reason = nullptr; ///< why the snapshot cannot hold them
  };
  static const LeafKind leafKinds[];

  void addViewProp(vtkProp* viewProp);
  void addPlain(const PlainProp& plain);
  void addLeaf(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addLevel(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addImage(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addVolume(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addActor(vtkProp* leaf, vtkMatrix4x4* matrix);
  void addTaken(const DrawnActor& taken);
  void addTranslucent(
    const DrawnActor& taken, DrawnProp& prop, const TextureCutout& cutout, const char* whyUncut);
  /// True if the view prop is to cast.
  /// @param byDefault true if it is, but for its key
  bool casts(bool byDefault) const;
  bool castsTranslucent() const { return this->casts(this->translucent_.casts); }
  void addPass(const DrawnActor& taken, DrawnProp& prop, const std::string& texture);
  /// Add a box of VTK's to that of translucent receivers and volumes.
  void addBox(const double* sides, const glm::dmat4& worldFromModel);
  DrawnProp propOf(vtkActor* actor, vtkMapper* mapper, vtkMatrix4x4* matrix);
  void skip(vtkObjectBase* what, const char* why);
  void note(PropNotes::Kind kind, vtkMapper* mapper, const std::string& why = {})
  {
    this->notes_.add(kind, this->number_, mapper, why);
  }

  vtkRenderer* renderer_;
  PropMemory& memory_;
  TranslucentRole translucent_;
  DrawnProps drawn_;
  BlockFinder blocks_;
  int number_ = 0; ///< of the view prop
  vtkProp* viewProp_ = nullptr;
  std::size_t path_ = 0; ///< DrawnProp::path of the leaf
  PropNotes notes_;
  bool isBoxed_ = true; ///< false: translucent receivers may leave their mappers' boxes
};

} // namespace gnomon
