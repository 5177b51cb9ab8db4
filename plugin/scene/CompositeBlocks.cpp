#include "plugin/scene/CompositeBlocks.h"

#include "vtkActor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"

#include <cstddef>
#include <unordered_map>
#include <unordered_set>

namespace gnomon
{
namespace
{

/// What a mapper's scalars are coloured by, ready to be asked; null where it shows none.
vtkScalarsToColors* coloursOf(vtkMapper* mapper)
{
  vtkScalarsToColors* colours = mapper->GetScalarVisibility() ? mapper->GetLookupTable() : nullptr;
  if (colours)
  {
    colours->Build();
  }
  return colours;
}

vtkDataArray* scalarsOf(vtkMapper* mapper, vtkPolyData* data)
{
  int cellFlag = 0;
  return vtkAbstractMapper::GetScalars(data, mapper->GetScalarMode(), mapper->GetArrayAccessMode(),
    mapper->GetArrayId(), mapper->GetArrayName(), cellFlag);
}

bool areOpaque(vtkMapper* mapper, vtkScalarsToColors* colours, vtkDataArray* scalars)
{
  return colours->IsOpaque(scalars, mapper->GetColorMode(), mapper->GetArrayComponent());
}

/// Walks a composite data set as vtkCompositePolyDataMapper2::BuildRenderValues does: the innermost
/// setting on the way to a block counts, so that a visible block may hang below a hidden one. A
/// block that appears twice is drawn once, with the settings of its last place.
class BlockWalk
{
public:
  BlockWalk(vtkActor* actor, vtkCompositePolyDataMapper2* mapper)
    : mapper_(mapper)
    , attributes_(mapper->GetCompositeDataDisplayAttributes())
    , colours_(coloursOf(mapper))
    , forceOpaque_(actor->GetForceOpaque())
    , textureOpaque_(!actor->GetTexture() || !actor->GetTexture()->IsTranslucent())
  {
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
      const bool opaque = this->forceOpaque_ ||
        (opacity >= 1.0 && this->textureOpaque_ &&
          (!this->colours_ ||
            areOpaque(this->mapper_, this->colours_, scalarsOf(this->mapper_, data))));
      const auto [place, isNew] = this->placeOf_.emplace(data, this->blocks_.size());
      if (isNew)
      {
        this->blocks_.emplace_back();
      }
      this->blocks_[place->second] = { data, visible, opaque };
    }
  }

  vtkCompositePolyDataMapper2* mapper_;
  vtkCompositeDataDisplayAttributes* attributes_;
  vtkScalarsToColors* colours_;
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

//------------------------------------------------------------------------------
std::vector<vtkPolyData*> drawnParts(vtkCompositePolyDataMapper* mapper, bool translucent)
{
  std::vector<vtkPolyData*> parts;
  vtkScalarsToColors* colours = coloursOf(mapper);
  std::unordered_set<vtkPolyData*> seen;
  const auto add = [&](vtkDataObject* object)
  {
    auto* data = vtkPolyData::SafeDownCast(object);
    vtkDataArray* scalars = data && colours ? scalarsOf(mapper, data) : nullptr;
    const bool opaque = !scalars || areOpaque(mapper, colours, scalars);
    if (data && opaque != translucent && seen.insert(data).second)
    {
      parts.push_back(data);
    }
  };
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* tree = vtkCompositeDataSet::SafeDownCast(input))
  {
    for (vtkDataObject* leaf : vtk::Range(tree, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      add(leaf);
    }
  }
  else
  {
    add(input);
  }
  return parts;
}

} // namespace gnomon
