#include "plugin/scene/PropFinder.h"

#include "plugin/scene/SheetReading.h"
#include "plugin/scene/SolidSizes.h"
#include "plugin/scene/VolumeReceivers.h"
#include "plugin/vtkGnomonPropKeys.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLODProp3D.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkProp3DFollower.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <utility>

namespace gnomon
{
namespace
{

/// Add an actor to those that a list of DrawnProps names.
void nameDrawer(const DrawnActor& taken, std::vector<const void*>& drawers)
{
  drawers.push_back(taken.drawing.actor);
  if (!isPlainActor(taken.actor))
  {
    drawers.push_back(taken.drawing.mapper);
  }
}

/// True if a shader places what an actor draws: solids, or a user's vertices.
bool isPlacedByShader(const DrawnActor& taken, const DrawnProp& prop)
{
  return prop.isMoved || taken.kind == MapperKind::Solids || taken.kind == MapperKind::Molecule ||
    isSizedInPixels(taken.actor->GetProperty());
}

/// True if a prop was told to cast.
bool askedToCast(vtkProp* viewProp)
{
  vtkInformation* keys = viewProp->GetPropertyKeys();
  return keys && keys->Has(vtkGnomonPropKeys::CASTS()) && vtkGnomonPropKeys::GetCasts(viewProp);
}

/// True unless its keys keep a prop both from casting and from receiving.
bool mayCastOrReceive(vtkProp* viewProp)
{
  return !viewProp->GetPropertyKeys() || vtkGnomonPropKeys::GetCasts(viewProp) ||
    vtkGnomonPropKeys::GetReceives(viewProp);
}

} // namespace

PropFinder::PropFinder(vtkRenderer* renderer, PropMemory& memory, TranslucentRole translucent)
  : renderer_(renderer)
  , memory_(memory)
  , translucent_(translucent)
  , blocks_(renderer, drawn_.blocks,
      [this](vtkObjectBase* what, const char* why) { this->skip(what, why); })
{
  const auto count = static_cast<std::size_t>(renderer->GetViewProps()->GetNumberOfItems());
  this->drawn_.props.reserve(count);
  this->drawn_.blocks.reserve(count);
}

void PropFinder::addViewProp(vtkProp* viewProp, int number)
{
  this->number_ = number;
  this->viewProp_ = viewProp;
  this->path_ = 0;
  this->addViewProp(viewProp);
}

bool PropFinder::casts(bool byDefault) const
{
  return byDefault ? vtkGnomonPropKeys::GetCasts(this->viewProp_) : askedToCast(this->viewProp_);
}

void PropFinder::addPass(const DrawnActor& taken, DrawnProp& prop, const std::string& texture)
{
  prop.firstBlock = this->drawn_.blocks.size();
  prop.blockCount = this->blocks_.add(taken, prop, texture);
  if (prop.blockCount > 0)
  {
    this->drawn_.props.push_back(prop);
  }
}

void PropFinder::addBox(const double* sides, const glm::dmat4& worldFromModel)
{
  const Bounds model{ { sides[0], sides[2], sides[4] }, { sides[1], sides[3], sides[5] } };
  if (!model.empty())
  {
    this->drawn_.pointsWorld.add(affinelyTransformed(model, worldFromModel));
  }
}

void PropFinder::skip(vtkObjectBase* what, const char* why)
{
  if (mayCastOrReceive(this->viewProp_))
  {
    auto* const actor = vtkActor::SafeDownCast(what);
    this->note(PropNotes::Kind::LeftOut, actor ? actor->GetMapper() : vtkMapper::SafeDownCast(what),
      std::string(what->GetClassName()) + " (" + why + ")");
  }
}

void PropFinder::addViewProp(vtkProp* viewProp)
{
  if (!viewProp->GetVisibility())
  {
    return;
  }
  const auto number = static_cast<std::size_t>(this->number_);
  if (const PlainProp* plain = this->memory_.records.unchanged(number))
  {
    this->addPlain(*plain);
    return;
  }
  if (isPlainActor(viewProp))
  {
    this->addLeaf(viewProp, viewProp->GetMatrix());
    return;
  }
  auto* follower = vtkProp3DFollower::SafeDownCast(viewProp);
  if (follower)
  {
    follower->GetBounds(); // makes the follower place its prop, as VTK does before drawing
  }
  if (!follower && !viewProp->IsA("vtkAssembly") && !viewProp->IsA("vtkPropAssembly"))
  {
    this->addLeaf(viewProp, viewProp->GetMatrix());
    return;
  }
  viewProp->InitPathTraversal();
  while (vtkAssemblyPath* path = viewProp->GetNextPath())
  {
    vtkAssemblyNode* node = path->GetLastNode();
    // As in VTK's drawing, only the leaf's own visibility counts below the view prop.
    if (node->GetViewProp()->GetVisibility())
    {
      this->addLeaf(node->GetViewProp(), node->GetMatrix());
    }
    ++this->path_;
  }
}

/// Return a prop without its blocks.
DrawnProp PropFinder::propOf(vtkActor* actor, vtkMapper* mapper, vtkMatrix4x4* matrix)
{
  DrawnProp prop;
  prop.viewProp = this->viewProp_;
  prop.number = this->number_;
  prop.path = this->path_;
  prop.actor = actor;
  prop.mapper = mapper;
  prop.worldFromModel = toGlm(matrix);
  prop.firstBlock = this->drawn_.blocks.size();
  // While an assembly draws, its property keys replace those of its parts.
  if (this->viewProp_->GetPropertyKeys())
  {
    prop.casts = vtkGnomonPropKeys::GetCasts(this->viewProp_);
    prop.receives = vtkGnomonPropKeys::GetReceives(this->viewProp_);
    prop.oneSided = vtkGnomonPropKeys::GetOneSided(this->viewProp_);
    this->drawn_.anyCatcher =
      this->drawn_.anyCatcher || vtkGnomonPropKeys::GetShadowCatcher(this->viewProp_);
  }
  return prop;
}

/// Add a prop as addLeaf() would, from the answers of an earlier frame.
void PropFinder::addPlain(const PlainProp& plain)
{
  DrawnProp prop = this->propOf(plain.actor, plain.mapper, plain.actor->GetMatrix());
  prop.isPlain = true;
  prop.blockCount = 1;
  this->drawn_.blocks.push_back({ plain.data });
  takeNormals(plain.actor, this->drawn_.blocks.back());
  this->drawn_.props.push_back(std::move(prop));
}

/// The ways to take a leaf that is no plain actor. Its first base class in the table decides.
const PropFinder::LeafKind PropFinder::leafKinds[] = {
  { "vtkSkybox" },
  { "vtkActor", &PropFinder::addActor },
  { "vtkLODProp3D", &PropFinder::addLevel },
  { "vtkImageSlice", &PropFinder::addImage },
  { "vtkVolume", &PropFinder::addVolume },
  { "vtkTextActor3D" }, // annotations show no shadows
  { "vtkBillboardTextActor3D" },
  { "vtkLightActor" },
  { "vtkAxesActor" },
  { "vtkAnnotatedCubeActor" },
  { "vtkAssembly" }, // its leaves are taken one by one
  { "vtkProp3D", nullptr, "draws through props of its own" },
};

void PropFinder::addLeaf(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  if (isPlainActor(leaf))
  {
    this->addActor(leaf, matrix);
    return;
  }
  for (const LeafKind& kind : leafKinds)
  {
    if (leaf->IsA(kind.name))
    {
      if (kind.add)
      {
        (this->*kind.add)(leaf, matrix);
      }
      else if (kind.reason)
      {
        this->skip(leaf, kind.reason);
      }
      return;
    }
  }
}

/// Add the level of detail that VTK draws, where its owner is.
void PropFinder::addLevel(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  if (vtkProp3D* level = selectedLevel(static_cast<vtkLODProp3D*>(leaf)))
  {
    this->addLeaf(level, matrix);
  }
}

/// Add the rectangle of an image that is asked to cast. VTK draws it in the opaque pass.
void PropFinder::addImage(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  auto* const slice = static_cast<vtkImageSlice*>(leaf);
  if (!askedToCast(this->viewProp_))
  {
    if (slice->GetProperty()->GetDiffuse() > 0.0)
    {
      this->skip(slice, "not asked to cast");
    }
    return;
  }
  if (!slice->GetMapper())
  {
    return;
  }
  const ImageRectangle rectangle = this->memory_.images.find(slice);
  if (!rectangle.actor)
  {
    this->skip(slice->GetMapper(), "mapper not served");
    return;
  }
  DrawnProp prop = this->propOf(
    rectangle.actor, rectangle.actor->GetMapper(), matrix ? matrix : slice->GetMatrix());
  prop.clipPlanes = clipPlanesOf(slice->GetMapper());
  prop.blockCount = 1;
  DrawnBlock block;
  block.data = rectangle.data;
  block.drawnAs = rectangle.drawn;
  this->drawn_.blocks.push_back(block);
  this->drawn_.props.push_back(std::move(prop));
}

/// Add a volume that casts, receives or does both.
void PropFinder::addVolume(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  auto* const volume = static_cast<vtkVolume*>(leaf);
  vtkAbstractVolumeMapper* const mapper = volume->GetMapper();
  vtkMatrix4x4* const place = matrix ? matrix : volume->GetMatrix();
  const bool casts = this->translucent_.transmits && this->casts(this->translucent_.volumesCast);
  const bool receives =
    this->translucent_.volumesReceive && vtkGnomonPropKeys::GetReceives(this->viewProp_);
  const char* why = receives ? reasonAgainst(volume) : nullptr;
  if (receives && !why)
  {
    ++this->drawn_.volumeReceivers;
    this->addBox(mapper->GetBounds(), toGlm(place));
  }
  if (casts)
  {
    const auto blocks = this->memory_.volumes.find(volume, place, why);
    this->drawn_.volumes.insert(this->drawn_.volumes.end(), blocks.begin(), blocks.end());
  }
  if (why)
  {
    this->skip(mapper ? static_cast<vtkObjectBase*>(mapper) : volume, why);
  }
  if (!casts && vtkGnomonPropKeys::GetCasts(this->viewProp_))
  {
    this->note(PropNotes::Kind::Volume, nullptr);
  }
}

/// Add an actor that draws surfaces, if the snapshot can hold them.
void PropFinder::addActor(vtkProp* leaf, vtkMatrix4x4* matrix)
{
  auto* const actor = static_cast<vtkActor*>(leaf);
  if (!actor->GetMapper())
  {
    return;
  }
  DrawnActor taken{ actor,
    actorDrawing(actor, matrix ? matrix : actor->GetMatrix(), this->renderer_) };
  taken.copies = hasOwnFramebuffer(actor->GetMapper());
  taken.seenThrough = taken.copies || isSeenThrough(actor);
  if (taken.seenThrough)
  {
    nameDrawer(taken, this->drawn_.seenThrough);
  }
  vtkProperty* const property = actor->GetProperty();
  taken.lit = showsLight(property);
  const bool asSurface = drawnAsSurface(property, actor->GetMapper());
  const bool asPoints = !asSurface && property->GetRepresentation() == VTK_POINTS;
  if (!asSurface && !(asPoints && property->GetRenderPointsAsSpheres()))
  {
    if (taken.lit)
    {
      this->skip(actor, asPoints ? "as points" : "as a wireframe");
    }
    return;
  }
  if (!taken.drawing.actor)
  {
    this->skip(actor, "draws through an actor of its own");
    return;
  }
  taken.kind = kindOf(taken.drawing.mapper);
  taken.mapper = this->blocks_.update(this->viewProp_, taken.drawing.mapper, taken.kind);
  if (!taken.mapper)
  {
    return;
  }
  const bool drawsCells = taken.kind == MapperKind::PlainPolyData ||
    taken.kind == MapperKind::PolyData || taken.kind == MapperKind::Composite;
  if (asPoints && !drawsCells)
  {
    if (taken.lit)
    {
      this->skip(actor, "as points");
    }
    return;
  }
  this->addTaken(taken);
}

/// Add the surfaces of an actor that cast or receive, and note what its shadows leave out.
void PropFinder::addTaken(const DrawnActor& taken)
{
  vtkActor* const actor = taken.actor;
  DrawnProp prop = this->propOf(taken.drawing.actor, taken.mapper, taken.drawing.matrix);
  prop.clipPlanes = clipPlanesOf(taken.drawing.mapper);
  prop.receives = prop.receives && taken.kind != MapperKind::Splats; // VTK does not light splats
  const char* uncutReason = nullptr;
  const TextureCutout cutout = this->memory_.cutouts.find(actor, taken.drawing.mapper,
    this->viewProp_->GetPropertyKeys(), this->castsTranslucent(), uncutReason);
  prop.cutout = cutout.mask;
  prop.textureTransform = cutout.transform;
  prop.isMoved = mayMoveVertices(actor);
  const std::size_t before = this->drawn_.props.size();
  const bool opaque = actor->HasOpaqueGeometry();
  // A plain prop is either opaque or translucent, and VTK takes equally long to answer either.
  const bool eitherOr = isPlainActor(actor) && taken.kind == MapperKind::PlainPolyData;
  const bool translucent = eitherOr ? !opaque : actor->HasTranslucentPolygonalGeometry() != 0;
  if (prop.receives && (translucent || taken.seenThrough))
  {
    nameDrawer(taken, this->drawn_.translucentReceivers);
    this->isBoxed_ = this->isBoxed_ && !isPlacedByShader(taken, prop);
    this->addBox(taken.drawing.mapper->GetBounds(), prop.worldFromModel);
    if (taken.copies)
    {
      this->note(PropNotes::Kind::Copied, taken.mapper);
    }
  }
  if (opaque)
  {
    this->addPass(taken, prop, cutout.texture);
    if (!taken.lit && prop.receives)
    {
      this->note(PropNotes::Kind::Unlit, taken.mapper);
    }
    if (eitherOr && taken.lit && !taken.seenThrough && !prop.isMoved &&
      !isSizedInPixels(actor->GetProperty()) && this->viewProp_ == actor &&
      this->drawn_.props.size() > before)
    {
      this->drawn_.props.back().isPlain =
        this->memory_.records.remember(static_cast<std::size_t>(this->number_), actor);
    }
  }
  if (translucent && this->castsTranslucent())
  {
    this->addTranslucent(taken, prop, cutout, uncutReason);
  }
  else if (translucent && prop.casts)
  {
    this->note(PropNotes::Kind::NotCasting, taken.mapper);
  }
  if (prop.casts && this->drawn_.props.size() > before)
  {
    if (prop.isMoved)
    {
      this->notes_.addMoved();
    }
    if (uncutReason)
    {
      this->notes_.addUncut(uncutReason);
    }
  }
}

/// Add what the translucent pass draws of an actor that casts.
/// @param whyUncut why its texture's alpha does not count; null if it does
void PropFinder::addTranslucent(
  const DrawnActor& taken, DrawnProp& prop, const TextureCutout& cutout, const char* whyUncut)
{
  prop.translucent = true;
  if (this->translucent_.transmits)
  {
    prop.transmits = vtkGnomonPropKeys::GetTransmits(this->viewProp_);
  }
  if (prop.transmits != vtkGnomonPropKeys::TRANSMITS_NOTHING)
  {
    const char* const why = whyUncut ? whyUncut : whyNoSheet(taken, prop);
    if (why)
    {
      prop.transmits = vtkGnomonPropKeys::TRANSMITS_NOTHING;
      this->note(PropNotes::Kind::Blocking, taken.mapper, why);
    }
    else
    {
      prop.cutout = cutout.alpha;
    }
  }
  this->addPass(taken, prop, cutout.texture);
}

DrawnProps PropFinder::take()
{
  this->notes_.tell(this->drawn_);
  this->drawn_.pointsWorld = this->isBoxed_ ? this->drawn_.pointsWorld : Bounds();
  return std::move(this->drawn_);
}

} // namespace gnomon
