#include "plugin/vtk_versions/BlockWalk.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"

namespace gnomon
{

BlockScalars::BlockScalars(vtkMapper* mapper, bool perBlock)
  : shown(mapper->GetScalarVisibility())
  , mode(mapper->GetScalarMode())
  , accessMode(mapper->GetArrayAccessMode())
  , arrayId(mapper->GetArrayId())
  , arrayName(mapper->GetArrayName() ? mapper->GetArrayName() : "")
  , component(mapper->GetArrayComponent())
  , colourMode(mapper->GetColorMode())
  , colours(shown || perBlock ? mapper->GetLookupTable() : nullptr)
{
}

void BlockScalars::takeFrom(vtkCompositeDataDisplayAttributes* attributes, vtkDataObject* object)
{
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  if (attributes->HasBlockScalarVisibility(object))
  {
    this->shown = attributes->GetBlockScalarVisibility(object);
  }
  if (attributes->HasBlockScalarMode(object))
  {
    this->mode = attributes->GetBlockScalarMode(object);
  }
  if (attributes->HasBlockArrayAccessMode(object))
  {
    this->accessMode = attributes->GetBlockArrayAccessMode(object);
  }
  if (attributes->HasBlockArrayId(object))
  {
    this->arrayId = attributes->GetBlockArrayId(object);
  }
  if (attributes->HasBlockArrayName(object))
  {
    this->arrayName = attributes->GetBlockArrayName(object);
  }
  if (attributes->HasBlockArrayComponent(object))
  {
    this->component = attributes->GetBlockArrayComponent(object);
  }
  if (attributes->HasBlockColorMode(object))
  {
    this->colourMode = attributes->GetBlockColorMode(object);
  }
  if (attributes->HasBlockLookupTable(object))
  {
    this->colours = attributes->GetBlockLookupTable(object);
  }
#else
  static_cast<void>(attributes);
  static_cast<void>(object);
#endif
}

bool BlockScalars::areOpaque(vtkPolyData* data) const
{
  if (!this->shown || !this->colours)
  {
    return true;
  }
  this->colours->Build();
  int cellFlag = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(
    data, this->mode, this->accessMode, this->arrayId, this->arrayName.c_str(), cellFlag);
#if GNOMON_VTK_HAS_BLOCK_BATCHES
  unsigned char ghostsToSkip = 0;
  vtkUnsignedCharArray* ghosts = vtkAbstractMapper::GetGhostArray(data, this->mode, ghostsToSkip);
  return this->colours->IsOpaque(scalars, this->colourMode, this->component, ghosts, ghostsToSkip);
#else
  return this->colours->IsOpaque(scalars, this->colourMode, this->component);
#endif
}

BlockWalk::BlockWalk(vtkActor* actor, vtkMapper* mapper,
  vtkCompositeDataDisplayAttributes* attributes, bool scalarsPerBlock)
  : attributes_(attributes)
  , scalarsPerBlock_(scalarsPerBlock)
  , forceOpaque_(actor->GetForceOpaque())
  , textureOpaque_(!actor->GetTexture() || !actor->GetTexture()->IsTranslucent())
{
  this->walk(mapper->GetInputDataObject(0, 0), true, actor->GetProperty()->GetOpacity(),
    BlockScalars(mapper, scalarsPerBlock));
}

std::vector<vtkPolyData*> BlockWalk::drawn(bool translucent) const
{
  std::vector<vtkPolyData*> drawn;
  for (const Block& block : this->blocks_)
  {
    if (block.visible && block.opaque != translucent)
    {
      drawn.push_back(block.data);
    }
  }
  return drawn;
}

void BlockWalk::walk(
  vtkDataObject* object, bool visible, double opacity, const BlockScalars& scalars)
{
  if (this->attributes_ && this->attributes_->HasBlockVisibility(object))
  {
    visible = this->attributes_->GetBlockVisibility(object);
  }
  if (this->attributes_ && this->attributes_->HasBlockOpacity(object))
  {
    opacity = this->attributes_->GetBlockOpacity(object);
  }
  if (this->attributes_ && this->scalarsPerBlock_)
  {
    BlockScalars own = scalars;
    own.takeFrom(this->attributes_, object);
    this->add(object, visible, opacity, own);
  }
  else
  {
    this->add(object, visible, opacity, scalars);
  }
}

void BlockWalk::add(
  vtkDataObject* object, bool visible, double opacity, const BlockScalars& scalars)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes))
    {
      this->walk(child, visible, opacity, scalars);
    }
  }
  else if (auto* data = vtkPolyData::SafeDownCast(object))
  {
    const bool opaque =
      this->forceOpaque_ || (opacity >= 1.0 && this->textureOpaque_ && scalars.areOpaque(data));
    const auto [place, isNew] = this->placeOf_.emplace(data, this->blocks_.size());
    if (isNew)
    {
      this->blocks_.emplace_back();
    }
    this->blocks_[place->second] = { data, visible, opaque };
  }
}

} // namespace gnomon
