#include "plugin/scene/CompositeBlocks.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"

#include <cstddef>
#include <unordered_map>

namespace gnomon
{
namespace
{

/// Walks a composite data set as vtkCompositePolyDataMapper2::BuildRenderValues does: the innermost
/// setting on the way to a block counts, so that a visible block may hang below a hidden one. A
/// block that appears twice is drawn once, with the settings of its last place.
class BlockWalk
{
public:
  BlockWalk(vtkActor* actor, vtkCompositePolyDataMapper2* mapper)
    : mapper_(mapper)
    , attributes_(mapper->GetCompositeDataDisplayAttributes())
    , colors_(mapper->GetScalarVisibility() ? mapper->GetLookupTable() : nullptr)
    , forceOpaque_(actor->GetForceOpaque())
    , textureOpaque_(!actor->GetTexture() || !actor->GetTexture()->IsTranslucent())
  {
    if (this->colors_)
    {
      this->colors_->Build();
    }
    this->walk(mapper->GetInputDataObject(0, 0), true, actor->GetProperty()->GetOpacity());
  }

  /// The polydata that one of the passes draws, in the order of the tree.
  std::vector<vtkPolyData*> drawn(bool translucent) const
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

private:
  struct Block
  {
    vtkPolyData* data;
    bool visible;
    bool opaque;
  };

  void walk(vtkDataObject* object, bool visible, double opacity)
  {
    if (this->attributes_ && this->attributes_->HasBlockVisibility(object))
    {
      visible = this->attributes_->GetBlockVisibility(object);
    }
    if (this->attributes_ && this->attributes_->HasBlockOpacity(object))
    {
      opacity = this->attributes_->GetBlockOpacity(object);
    }
    if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
    {
      for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::SkipEmptyNodes))
      {
        this->walk(child, visible, opacity);
      }
    }
    else if (auto* data = vtkPolyData::SafeDownCast(object))
    {
      const bool opaque =
        this->forceOpaque_ || (opacity >= 1.0 && this->textureOpaque_ && this->opaque(data));
      const auto [place, isNew] = this->placeOf_.emplace(data, this->blocks_.size());
      if (isNew)
      {
        this->blocks_.emplace_back();
      }
      this->blocks_[place->second] = { data, visible, opaque };
    }
  }

  bool opaque(vtkPolyData* data) const
  {
    if (!this->colors_)
    {
      return true;
    }
    int cellFlag = 0;
    vtkDataArray* scalars = vtkAbstractMapper::GetScalars(data, this->mapper_->GetScalarMode(),
      this->mapper_->GetArrayAccessMode(), this->mapper_->GetArrayId(),
      this->mapper_->GetArrayName(), cellFlag);
    return this->colors_->IsOpaque(
      scalars, this->mapper_->GetColorMode(), this->mapper_->GetArrayComponent());
  }

  vtkCompositePolyDataMapper2* mapper_;
  vtkCompositeDataDisplayAttributes* attributes_;
  vtkScalarsToColors* colors_;
  bool forceOpaque_;
  bool textureOpaque_;
  std::vector<Block> blocks_;
  std::unordered_map<vtkPolyData*, std::size_t> placeOf_;
};

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkPolyData*> drawnBlocks(
  vtkActor* actor, vtkCompositePolyDataMapper2* mapper, bool translucent)
{
  return BlockWalk(actor, mapper).drawn(translucent);
}

} // namespace gnomon
