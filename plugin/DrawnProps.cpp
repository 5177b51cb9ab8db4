#include "plugin/DrawnProps.h"

#include "plugin/vtkGnomonPropKeys.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTexture.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace gnomon
{
namespace
{

/// A mapper's clipping planes, as many as VTK applies.
std::vector<glm::dvec4> clipPlanesOf(vtkMapper* mapper)
{
  constexpr int mostPlanes = 6;
  std::vector<glm::dvec4> planes;
  const int count = std::min<int>(mapper->GetNumberOfClippingPlanes(), mostPlanes);
  for (int i = 0; i < count; ++i)
  {
    vtkPlane* plane = mapper->GetClippingPlanes()->GetItem(i);
    const glm::dvec3 normal = glm::make_vec3(plane->GetNormal());
    planes.emplace_back(normal, -glm::dot(normal, glm::make_vec3(plane->GetOrigin())));
  }
  return planes;
}

/// Mappers that are polydata mappers by type, but draw something else in place of the polygons.
bool drawsImpostors(vtkMapper* mapper)
{
  if (std::strcmp(mapper->GetClassName(), "vtkOpenGLPolyDataMapper") == 0)
  {
    return false; // nearly every mapper, and IsA() compares with all base classes
  }
  return mapper->IsA("vtkPointGaussianMapper") || mapper->IsA("vtkOpenGLSphereMapper") ||
    mapper->IsA("vtkOpenGLStickMapper");
}

/// Actors that hand a mapper, theirs or another one, to an actor of their own to draw.
bool drawsThroughAnother(vtkActor* actor)
{
  if (std::strcmp(actor->GetClassName(), "vtkOpenGLActor") == 0)
  {
    return false; // nearly every actor, and IsA() compares with all base classes
  }
  return actor->IsA("vtkFollower") || actor->IsA("vtkLODActor") ||
    actor->IsA("vtkQuadricLODActor") || actor->IsA("vtkSkybox");
}

class Finder
{
public:
  void addViewProp(vtkProp* viewProp);
  DrawnProps take();

private:
  void addLeaf(vtkProp* viewProp, std::size_t path, vtkProp* leaf, vtkMatrix4x4* matrix);
  void addBlocks(vtkActor* actor, vtkPolyDataMapper* mapper);
  void updateInput(vtkPolyDataMapper* mapper);
  void skip(const std::string& what) { ++this->skipped_[what]; }

  DrawnProps drawn_;
  std::unordered_set<vtkMapper*> updated_;
  std::map<std::string, int> skipped_; ///< what was left out, and how often
};

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

  /// Appends the polydata that the opaque pass draws, in the order of the tree.
  void appendDrawn(std::vector<vtkPolyData*>& blocks) const
  {
    for (const Block& block : this->blocks_)
    {
      if (block.drawn)
      {
        blocks.push_back(block.data);
      }
    }
  }

private:
  struct Block
  {
    vtkPolyData* data;
    bool drawn;
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
      const bool drawn = visible &&
        (this->forceOpaque_ || (opacity >= 1.0 && this->textureOpaque_ && this->opaque(data)));
      const auto [place, isNew] = this->placeOf_.emplace(data, this->blocks_.size());
      if (isNew)
      {
        this->blocks_.push_back({ data, drawn });
      }
      this->blocks_[place->second].drawn = drawn;
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

//------------------------------------------------------------------------------
void Finder::addViewProp(vtkProp* viewProp)
{
  if (!viewProp->GetVisibility())
  {
    return;
  }
  if (!viewProp->IsA("vtkAssembly") && !viewProp->IsA("vtkPropAssembly"))
  {
    this->addLeaf(viewProp, 0, viewProp, viewProp->GetMatrix());
    return;
  }
  std::size_t number = 0;
  viewProp->InitPathTraversal();
  while (vtkAssemblyPath* path = viewProp->GetNextPath())
  {
    vtkAssemblyNode* node = path->GetLastNode();
    // As when drawing, only the leaf's own visibility counts below the view prop.
    if (node->GetViewProp()->GetVisibility())
    {
      this->addLeaf(viewProp, number, node->GetViewProp(), node->GetMatrix());
    }
    ++number;
  }
}

//------------------------------------------------------------------------------
void Finder::addLeaf(vtkProp* viewProp, std::size_t path, vtkProp* leaf, vtkMatrix4x4* matrix)
{
  auto* actor = vtkActor::SafeDownCast(leaf);
  if (!actor)
  {
    if (leaf->IsA("vtkProp3D") && !leaf->IsA("vtkAssembly"))
    {
      this->skip(std::string(leaf->GetClassName()) + ": not an actor");
    }
    return;
  }
  if (!actor->GetMapper() || actor->GetProperty()->GetRepresentation() != VTK_SURFACE)
  {
    return;
  }
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  if (drawsThroughAnother(actor))
  {
    this->skip(std::string(actor->GetClassName()) + ": draws through an actor of its own");
    return;
  }
  if (!mapper || drawsImpostors(mapper))
  {
    this->skip(std::string(actor->GetMapper()->GetClassName()) + ": mapper not served");
    return;
  }
  if (mapper->GetNumberOfSubPieces() > 1)
  {
    this->skip(std::string(mapper->GetClassName()) + ": input drawn in several pieces");
    return;
  }
  if (mapper->GetNumberOfInputConnections(0) == 0)
  {
    return; // VTK says so when it draws
  }
  this->updateInput(mapper);
  if (!mapper->GetInputDataObject(0, 0) || !actor->HasOpaqueGeometry())
  {
    return;
  }

  DrawnProp prop;
  prop.viewProp = viewProp;
  prop.path = path;
  prop.actor = actor;
  prop.worldFromModel = toGlm(matrix ? matrix : actor->GetMatrix());
  prop.clipPlanes = clipPlanesOf(mapper);
  // Assemblies replace the property keys of their parts by their own when they draw.
  prop.casts = vtkGnomonPropKeys::GetCasts(viewProp);
  prop.receives = vtkGnomonPropKeys::GetReceives(viewProp);
  prop.oneSided = vtkGnomonPropKeys::GetOneSided(viewProp);
  prop.firstBlock = this->drawn_.blocks.size();
  this->addBlocks(actor, mapper);
  prop.blockCount = this->drawn_.blocks.size() - prop.firstBlock;
  this->drawn_.props.push_back(std::move(prop));
}

//------------------------------------------------------------------------------
void Finder::addBlocks(vtkActor* actor, vtkPolyDataMapper* mapper)
{
  if (auto* composite = vtkCompositePolyDataMapper2::SafeDownCast(mapper))
  {
    BlockWalk(actor, composite).appendDrawn(this->drawn_.blocks);
  }
  else if (vtkPolyData* data = mapper->GetInput())
  {
    this->drawn_.blocks.push_back(data);
  }
}

//------------------------------------------------------------------------------
void Finder::updateInput(vtkPolyDataMapper* mapper)
{
  // A trivial producer stands for data that was set by hand: there is nothing to run.
  vtkAlgorithm* input = mapper->GetInputAlgorithm();
  if (mapper->GetStatic() || input->IsA("vtkTrivialProducer") ||
    !this->updated_.insert(mapper).second)
  {
    return;
  }
  if (!mapper->IsA("vtkCompositePolyDataMapper2"))
  {
    input->UpdateInformation();
    vtkInformation* information = mapper->GetInputInformation();
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    information->Set(Pipeline::UPDATE_PIECE_NUMBER(), mapper->GetPiece());
    information->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), mapper->GetNumberOfPieces());
    information->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), mapper->GetGhostLevel());
  }
  input->Update();
}

//------------------------------------------------------------------------------
DrawnProps Finder::take()
{
  for (const auto& [what, count] : this->skipped_)
  {
    this->drawn_.notes.push_back(what + " (" + std::to_string(count) +
      (count == 1 ? " prop neither casts nor receives)" : " props neither cast nor receive)"));
  }
  return std::move(this->drawn_);
}

} // namespace

//------------------------------------------------------------------------------
glm::dmat4 toGlm(vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->Element[row][column];
    }
  }
  return result;
}

//------------------------------------------------------------------------------
DrawnProps findDrawnProps(vtkRenderer* renderer)
{
  Finder finder;
  vtkPropCollection* viewProps = renderer->GetViewProps();
  vtkCollectionSimpleIterator cookie;
  viewProps->InitTraversal(cookie);
  while (vtkProp* viewProp = viewProps->GetNextProp(cookie))
  {
    finder.addViewProp(viewProp);
  }
  return finder.take();
}

} // namespace gnomon
