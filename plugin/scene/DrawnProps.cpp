#include "plugin/scene/DrawnProps.h"

#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/GlyphInstances.h"
#include "plugin/scene/MapperInternals.h"
#include "plugin/scene/MapperKind.h"
#include "plugin/scene/PropMemory.h"
#include "plugin/scene/SolidSizes.h"
#include "plugin/scene/SplatSpheres.h"
#include "plugin/vtkGnomonPropKeys.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkDataSetMapper.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageMapper3D.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLODProp3D.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLMoleculeMapper.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp3DFollower.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>

namespace gnomon
{
namespace
{

/// True for nearly every prop. IsA() and casts compare with all base classes, which costs more.
bool isPlainActor(vtkProp* prop)
{
  return std::strcmp(prop->GetClassName(), "vtkOpenGLActor") == 0;
}

/// True if VTK draws lines or points of a polydata.
bool hasLinesOrPoints(const DrawnBlock& block)
{
  return block.data->GetNumberOfVerts() + block.data->GetNumberOfLines() > 0;
}

bool hasSurfaces(const DrawnBlock& block)
{
  const std::vector<SurfaceCells>& cells = cellsOf(block);
  return std::any_of(cells.begin(), cells.end(),
    [&block](SurfaceCells kind) { return cellCount(block.data, kind) > 0; });
}

/// Return a block of solids at the points of a polydata.
DrawnBlock solidsBlock(vtkMapper* mapper, vtkPolyData* data, SurfaceCells cells)
{
  DrawnBlock block;
  block.data = data;
  block.solids = mapper;
  block.solidCells = cells;
  return block;
}

/// True if a user's code changes the shaders that place an actor's vertices.
bool mayMoveVertices(vtkActor* actor)
{
  vtkShaderProperty* code = actor->GetShaderProperty();
  bool may = code->HasVertexShaderCode() || code->HasGeometryShaderCode();
  for (int i = 0; i < code->GetNumberOfShaderReplacements(); ++i)
  {
    may = may || code->GetNthShaderReplacementTypeAsString(i) != "Fragment";
  }
  return may;
}

/// True if a prop was told to cast. Only then does a translucent prop cast.
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

/// True if a light changes how a prop looks. The outlines that VTK's interactor styles put around
/// what is picked reflect nothing.
bool showsLight(vtkProperty* property)
{
  return property->GetLighting() &&
    (property->GetInterpolation() == VTK_PBR || property->GetDiffuse() > 0.0 ||
      property->GetSpecular() > 0.0);
}

/// Set the normals with which VTK shades a block's triangles. Flat or unlit properties have none.
/// The caller skips props whose vertices a user's shader code may move.
void takeNormals(vtkActor* actor, DrawnBlock& block)
{
  if (actor->GetProperty()->GetInterpolation() != VTK_FLAT && actor->GetProperty()->GetLighting())
  {
    block.normals = block.data->GetPointData()->GetNormals();
  }
}

/// Read a prop's shadow keys. While an assembly draws, its property keys replace those of its
/// parts.
void takeKeys(DrawnProp& prop)
{
  if (prop.viewProp->GetPropertyKeys())
  {
    prop.casts = vtkGnomonPropKeys::GetCasts(prop.viewProp);
    prop.receives = vtkGnomonPropKeys::GetReceives(prop.viewProp);
    prop.oneSided = vtkGnomonPropKeys::GetOneSided(prop.viewProp);
  }
}

/// True if a prop that is not an actor could show a shadow.
bool isLit(vtkProp* leaf)
{
  if (auto* slice = vtkImageSlice::SafeDownCast(leaf))
  {
    return slice->GetProperty()->GetDiffuse() > 0.0;
  }
  const char* const annotations[] = { "vtkTextActor3D", "vtkBillboardTextActor3D", "vtkLightActor",
    "vtkAxesActor", "vtkAnnotatedCubeActor" };
  return leaf->IsA("vtkProp3D") && !leaf->IsA("vtkAssembly") &&
    std::none_of(std::begin(annotations), std::end(annotations),
      [leaf](const char* name) { return leaf->IsA(name); });
}

/// True if VTK culls a prop for lack of bounds. A mapper of solids computes its bounds from cells,
/// although it draws points.
bool isCulled(vtkProp* viewProp, vtkMapper* mapper, MapperKind kind)
{
  vtkPolyData* data =
    kind == MapperKind::Solids ? static_cast<vtkPolyDataMapper*>(mapper)->GetInput() : nullptr;
  const double* const bounds =
    data && data->GetNumberOfCells() == 0 ? viewProp->GetBounds() : nullptr;
  return bounds && !vtkMath::AreBoundsInitialized(bounds);
}

class Finder
{
public:
  Finder(vtkRenderer* renderer, PropMemory& memory)
    : renderer_(renderer)
    , memory_(memory)
  {
    const auto count = static_cast<std::size_t>(renderer->GetViewProps()->GetNumberOfItems());
    this->drawn_.props.reserve(count);
    this->drawn_.blocks.reserve(count);
  }
  /// @param number of the prop in vtkRenderer::GetViewProps()
  void addViewProp(vtkProp* viewProp, int number)
  {
    const std::size_t first = this->drawn_.props.size();
    this->number_ = number;
    this->viewProp_ = viewProp;
    this->addViewProp(viewProp);
    std::for_each(this->drawn_.props.begin() + static_cast<std::ptrdiff_t>(first),
      this->drawn_.props.end(), [number](DrawnProp& prop) { prop.number = number; });
  }
  DrawnProps take();

private:
  void addViewProp(vtkProp* viewProp);
  void addPlain(const PlainProp& plain);
  void addLeaf(vtkProp* viewProp, std::size_t path, vtkProp* leaf, vtkMatrix4x4* matrix);
  void addImage(vtkProp* viewProp, std::size_t path, vtkImageSlice* slice, vtkMatrix4x4* matrix);
  bool serves(vtkMapper* mapper, MapperKind kind);
  void addBlocks(vtkActor* actor, vtkMapper* mapper, MapperKind kind,
    const glm::dmat4& worldFromModel, bool translucent);
  void addSolids(vtkMapper* mapper, const glm::dmat4& worldFromModel);
  void takePixelSizes(vtkActor* actor, std::size_t firstBlock);
  bool updateInput(vtkMapper* mapper, MapperKind kind);
  void skip(vtkObjectBase* what, const char* why)
  {
    if (mayCastOrReceive(this->viewProp_))
    {
      auto* const actor = vtkActor::SafeDownCast(what);
      this->name(this->skipped_[std::string(what->GetClassName()) + " (" + why + ")"],
        actor ? actor->GetMapper() : vtkMapper::SafeDownCast(what));
    }
  }

  /// Props of which something is to be told.
  struct NamedProps
  {
    int count = 0;
    std::string names; ///< of the first ones: numbers in GetViewProps(), with the data's sources
  };
  void name(NamedProps& props, vtkMapper* mapper) const;

  vtkRenderer* renderer_;
  PropMemory& memory_;
  DrawnProps drawn_;
  std::unordered_set<vtkMapper*> updated_;
  int number_ = 0; ///< of the view prop
  vtkProp* viewProp_ = nullptr;
  std::map<std::string, NamedProps> skipped_; ///< props left out
  NamedProps unlit_, notCasting_, copied_;
  std::map<std::string, int>
    uncut_;       ///< why props cast without a texture's holes, with their number
  int moved_ = 0; ///< number of props whose vertices shader code may move
};

//------------------------------------------------------------------------------
void Finder::name(NamedProps& props, vtkMapper* mapper) const
{
  constexpr int mostNames = 5;
  if (++props.count > mostNames)
  {
    return;
  }
  vtkAlgorithm* const source =
    mapper && mapper->GetNumberOfInputConnections(0) > 0 ? mapper->GetInputAlgorithm() : nullptr;
  props.names += (props.count > 1 ? ", " : "") + std::to_string(this->number_) +
    (source && !source->IsA("vtkTrivialProducer") ? std::string(" (") + source->GetClassName() + ")"
                                                  : "");
}

//------------------------------------------------------------------------------
void Finder::addViewProp(vtkProp* viewProp)
{
  const PlainProp* plain = this->memory_.plainProps.next(viewProp);
  if (!viewProp->GetVisibility())
  {
    return;
  }
  if (plain)
  {
    this->addPlain(*plain);
    return;
  }
  if (isPlainActor(viewProp))
  {
    this->addLeaf(viewProp, 0, viewProp, viewProp->GetMatrix());
    return;
  }
  auto* follower = vtkProp3DFollower::SafeDownCast(viewProp);
  if (follower)
  {
    follower->GetBounds(); // makes the follower place its prop, as VTK does before drawing
  }
  if (!follower && !viewProp->IsA("vtkAssembly") && !viewProp->IsA("vtkPropAssembly"))
  {
    this->addLeaf(viewProp, 0, viewProp, viewProp->GetMatrix());
    return;
  }
  std::size_t number = 0;
  viewProp->InitPathTraversal();
  while (vtkAssemblyPath* path = viewProp->GetNextPath())
  {
    vtkAssemblyNode* node = path->GetLastNode();
    // As in VTK's drawing, only the leaf's own visibility counts below the view prop.
    if (node->GetViewProp()->GetVisibility())
    {
      this->addLeaf(viewProp, number, node->GetViewProp(), node->GetMatrix());
    }
    ++number;
  }
}

//------------------------------------------------------------------------------
/// Add a prop as addLeaf() would, from the answers of an earlier frame.
void Finder::addPlain(const PlainProp& plain)
{
  DrawnProp prop;
  prop.viewProp = prop.actor = plain.actor;
  prop.mapper = plain.mapper;
  prop.worldFromModel = toGlm(plain.actor->GetMatrix());
  takeKeys(prop);
  prop.firstBlock = this->drawn_.blocks.size();
  prop.blockCount = 1;
  this->drawn_.blocks.push_back({ plain.data });
  takeNormals(plain.actor, this->drawn_.blocks.back());
  this->drawn_.props.push_back(std::move(prop));
}

//------------------------------------------------------------------------------
void Finder::addLeaf(vtkProp* viewProp, std::size_t path, vtkProp* leaf, vtkMatrix4x4* matrix)
{
  const bool isPlain = isPlainActor(leaf);
  auto* actor = isPlain ? static_cast<vtkActor*>(leaf) : vtkActor::SafeDownCast(leaf);
  if (!actor)
  {
    if (auto* levels = vtkLODProp3D::SafeDownCast(leaf))
    {
      if (vtkProp3D* level = selectedLevel(levels))
      {
        this->addLeaf(viewProp, path, level, matrix); // VTK draws it where its owner is
      }
    }
    else if (auto* slice = vtkImageSlice::SafeDownCast(leaf); slice && askedToCast(viewProp))
    {
      this->addImage(viewProp, path, slice, matrix);
    }
    else if (isLit(leaf))
    {
      this->skip(leaf,
        leaf->IsA("vtkVolume")         ? "a volume"
          : leaf->IsA("vtkImageSlice") ? "not asked to cast"
                                       : "draws through props of its own");
    }
    return;
  }
  if (!actor->GetMapper() || (!isPlain && actor->IsA("vtkSkybox")))
  {
    return;
  }
  const ActorDrawing drawing =
    actorDrawing(actor, matrix ? matrix : actor->GetMatrix(), this->renderer_);
  const auto nameDrawer = [&](std::vector<const void*>& drawers)
  {
    drawers.push_back(drawing.actor);
    if (!isPlain)
    {
      drawers.push_back(drawing.mapper);
    }
  };
  const bool copies = hasOwnFramebuffer(actor->GetMapper());
  const bool seenThrough = copies || isSeenThrough(actor);
  if (seenThrough)
  {
    nameDrawer(this->drawn_.seenThrough);
  }
  const bool lit = showsLight(actor->GetProperty());
  const bool asSurface = drawnAsSurface(actor->GetProperty(), actor->GetMapper());
  const bool asPoints = !asSurface && actor->GetProperty()->GetRepresentation() == VTK_POINTS;
  const bool pointsAreSpheres = actor->GetProperty()->GetRenderPointsAsSpheres();
  const bool sizedInPixels = pointsAreSpheres || drawsTubes(actor->GetProperty());
  if (!asSurface && !(asPoints && pointsAreSpheres))
  {
    if (lit)
    {
      this->skip(actor, asPoints ? "as points" : "as a wireframe");
    }
    return;
  }
  if (!drawing.actor)
  {
    this->skip(actor, "draws through an actor of its own");
    return;
  }
  vtkMapper* mapper = drawing.mapper;
  MapperKind kind = kindOf(mapper);
  if (!this->serves(mapper, kind) || !this->updateInput(mapper, kind))
  {
    return; // VTK itself reports a mapper without input
  }
  if (isCulled(viewProp, mapper, kind))
  {
    return;
  }
  if (kind == MapperKind::DataSet)
  {
    mapper = innerMapper(static_cast<vtkDataSetMapper*>(mapper));
    kind = MapperKind::PolyData;
    this->updateInput(mapper, kind);
  }
  const bool isPolyData = kind == MapperKind::PlainPolyData || kind == MapperKind::PolyData;
  if (asPoints && !isPolyData)
  {
    if (lit)
    {
      this->skip(actor, "as points");
    }
    return;
  }

  DrawnProp prop;
  prop.viewProp = viewProp;
  prop.path = path;
  prop.actor = drawing.actor;
  prop.mapper = mapper;
  prop.worldFromModel = toGlm(drawing.matrix);
  prop.clipPlanes = clipPlanesOf(drawing.mapper);
  takeKeys(prop);
  prop.receives = prop.receives && kind != MapperKind::Splats; // VTK does not light splats
  const char* uncutReason = nullptr;
  const TextureCutout cutout =
    this->memory_.cutouts.find(actor, drawing.mapper, viewProp->GetPropertyKeys(), uncutReason);
  prop.cutout = cutout.mask;
  prop.textureTransform = cutout.transform;
  prop.isMoved = mayMoveVertices(actor);
  const auto add = [&](bool translucent)
  {
    prop.translucent = translucent;
    prop.firstBlock = this->drawn_.blocks.size();
    this->addBlocks(actor, mapper, kind, prop.worldFromModel, translucent);
    prop.blockCount = this->drawn_.blocks.size() - prop.firstBlock;
    if (sizedInPixels && isPolyData)
    {
      this->takePixelSizes(actor, prop.firstBlock);
    }
    const auto first = this->drawn_.blocks.begin() + static_cast<std::ptrdiff_t>(prop.firstBlock);
    if (std::none_of(first, this->drawn_.blocks.end(), hasSurfaces))
    {
      if (lit && std::any_of(first, this->drawn_.blocks.end(), hasLinesOrPoints))
      {
        this->skip(mapper, "lines or points");
      }
      this->drawn_.blocks.resize(prop.firstBlock);
      return;
    }
    for (std::size_t i = prop.firstBlock; prop.cutout && i < this->drawn_.blocks.size(); ++i)
    {
      DrawnBlock& block = this->drawn_.blocks[i];
      block.textureCoordinates = textureCoordinates(mapper, cutout.texture, block.data);
    }
    for (std::size_t i = prop.firstBlock; !prop.isMoved && i < this->drawn_.blocks.size(); ++i)
    {
      takeNormals(actor, this->drawn_.blocks[i]);
    }
    this->drawn_.props.push_back(prop);
  };
  const std::size_t before = this->drawn_.props.size();
  const bool opaque = actor->HasOpaqueGeometry();
  // A plain prop is either opaque or translucent, and VTK takes equally long to answer either.
  const bool eitherOr = isPlain && kind == MapperKind::PlainPolyData;
  const bool translucent = eitherOr ? !opaque : actor->HasTranslucentPolygonalGeometry() != 0;
  if (prop.receives && (translucent || seenThrough))
  {
    nameDrawer(this->drawn_.translucentReceivers);
    if (copies)
    {
      this->name(this->copied_, mapper);
    }
  }
  if (opaque)
  {
    add(false);
    if (!lit && prop.receives)
    {
      this->name(this->unlit_, mapper);
    }
    if (eitherOr && lit && !seenThrough && !prop.isMoved && !sizedInPixels && viewProp == actor &&
      this->drawn_.props.size() > before)
    {
      this->memory_.plainProps.remember(actor);
    }
  }
  if (translucent && askedToCast(viewProp))
  {
    add(true);
  }
  else if (translucent && prop.casts)
  {
    this->name(this->notCasting_, mapper);
  }
  if (prop.casts && this->drawn_.props.size() > before)
  {
    this->moved_ += prop.isMoved ? 1 : 0;
    if (uncutReason)
    {
      ++this->uncut_[uncutReason];
    }
  }
}

//------------------------------------------------------------------------------
/// Add the rectangle of an image that is asked to cast. VTK draws it in the opaque pass.
void Finder::addImage(
  vtkProp* viewProp, std::size_t path, vtkImageSlice* slice, vtkMatrix4x4* matrix)
{
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
  DrawnProp prop;
  prop.viewProp = viewProp;
  prop.path = path;
  prop.actor = rectangle.actor;
  prop.mapper = rectangle.actor->GetMapper();
  prop.worldFromModel = toGlm(matrix ? matrix : slice->GetMatrix());
  prop.clipPlanes = clipPlanesOf(slice->GetMapper());
  takeKeys(prop);
  prop.firstBlock = this->drawn_.blocks.size();
  prop.blockCount = 1;
  DrawnBlock block;
  block.data = rectangle.data;
  block.drawnAs = rectangle.drawn;
  this->drawn_.blocks.push_back(block);
  this->drawn_.props.push_back(std::move(prop));
}

//------------------------------------------------------------------------------
/// True if the snapshot can hold a mapper's surfaces; if not, count it as left out.
bool Finder::serves(vtkMapper* mapper, MapperKind kind)
{
  const char* reason = reasonAgainst(mapper, kind);
  if (reason)
  {
    this->skip(mapper, reason);
  }
  return !reason;
}

//------------------------------------------------------------------------------
/// List the blocks that a mapper draws for an actor in one of the two passes.
void Finder::addBlocks(vtkActor* actor, vtkMapper* mapper, MapperKind kind,
  const glm::dmat4& worldFromModel, bool translucent)
{
  std::vector<DrawnBlock>& blocks = this->drawn_.blocks;
  if (kind == MapperKind::Composite || kind == MapperKind::Parts)
  {
    for (vtkPolyData* data : drawnBlocks(actor, mapper, translucent))
    {
      blocks.push_back({ data });
    }
  }
  else if (kind == MapperKind::Solids)
  {
    this->addSolids(mapper, worldFromModel);
  }
  else if (kind == MapperKind::Molecule)
  {
    for (vtkMapper* solids : solidMappers(static_cast<vtkOpenGLMoleculeMapper*>(mapper)))
    {
      if (this->updateInput(solids, MapperKind::Solids))
      {
        this->addSolids(solids, worldFromModel);
      }
    }
  }
  else if (kind == MapperKind::Splats)
  {
    for (vtkPolyData* data : splatBlocks(static_cast<vtkPointGaussianMapper*>(mapper)))
    {
      blocks.push_back(solidsBlock(mapper, data, SurfaceCells::Spheres));
    }
  }
  else if (kind == MapperKind::Glyphs)
  {
    for (const Glyph& glyph : drawnGlyphs(static_cast<vtkGlyph3DMapper*>(mapper)))
    {
      blocks.push_back({ glyph.data, glyph.points, glyph.source });
    }
  }
  else if (vtkPolyData* data = static_cast<vtkPolyDataMapper*>(mapper)->GetInput())
  {
    blocks.push_back({ data });
  }
}

//------------------------------------------------------------------------------
/// Add a mapper's solids if the snapshot can hold them.
void Finder::addSolids(vtkMapper* mapper, const glm::dmat4& worldFromModel)
{
  const std::optional<DrawnSolids> drawn = drawnSolids(mapper);
  if (const char* reason = reasonAgainstSolids(drawn, mapper, worldFromModel))
  {
    this->skip(mapper, reason);
    return;
  }
  this->drawn_.blocks.push_back(
    solidsBlock(mapper, static_cast<vtkPolyDataMapper*>(mapper)->GetInput(), drawn->cells));
}

//------------------------------------------------------------------------------
/// Store the radii of spheres at vertices and tubes along lines in the last blocks.
void Finder::takePixelSizes(vtkActor* actor, std::size_t firstBlock)
{
  const PixelSizes sizes = pixelSizes(actor->GetProperty(), this->renderer_);
  const bool surface = actor->GetProperty()->GetRepresentation() == VTK_SURFACE;
  for (std::size_t i = firstBlock; i < this->drawn_.blocks.size(); ++i)
  {
    DrawnBlock& block = this->drawn_.blocks[i];
    block.pointRadiusFromWorld = sizes.pointRadiusFromWorld;
    block.lineRadiusFromWorld = surface ? sizes.lineRadiusFromWorld : glm::dvec4(0.0);
    block.drawsTriangles = surface;
    if (!surface && block.data->GetNumberOfCells() > block.data->GetNumberOfVerts())
    {
      this->skip(actor, "corners of lines and polygons as points");
    }
  }
}

//------------------------------------------------------------------------------
/// Update a mapper's input.
/// @return true if there is any
bool Finder::updateInput(vtkMapper* mapper, MapperKind kind)
{
  if (mapper->GetNumberOfInputConnections(0) == 0)
  {
    return false;
  }
  if (!mapper->GetStatic() && this->updated_.insert(mapper).second)
  {
    runInput(mapper, kind);
  }
  return mapper->GetInputDataObject(0, 0) != nullptr;
}

//------------------------------------------------------------------------------
DrawnProps Finder::take()
{
  const auto tell = [this](const NamedProps& props, const std::string& one, const std::string& many)
  {
    if (props.count > 0)
    {
      this->drawn_.notes.push_back(std::to_string(props.count) +
        (props.count == 1 ? " prop " + one + ": view prop " : " props " + many + ": view props ") +
        props.names);
    }
  };
  for (const auto& [what, props] : this->skipped_)
  {
    this->drawn_.leftOut.push_back(what);
    tell(props, "neither casts nor receives, " + what, "neither cast nor receive, " + what);
  }
  tell(this->unlit_, "is unlit and shows no shadow", "are unlit and show no shadow");
  tell(this->notCasting_, "is translucent and casts nothing unless its key asks",
    "are translucent and cast nothing unless their keys ask");
  tell(this->copied_, "is drawn into a framebuffer of its own and receives as if translucent",
    "are drawn into framebuffers of their own and receive as if translucent");
  for (const auto& [why, count] : this->uncut_)
  {
    this->drawn_.notes.push_back("holes in textures are not cut out of shadows: " + why + " (" +
      std::to_string(count) + (count == 1 ? " prop casts as a whole)" : " props cast as a whole)"));
  }
  if (this->moved_ > 0)
  {
    this->drawn_.notes.push_back("shadows ignore shader code that may move vertices (" +
      std::to_string(this->moved_) + (this->moved_ == 1 ? " prop)" : " props)"));
  }
  return std::move(this->drawn_);
}

} // namespace

//------------------------------------------------------------------------------
glm::dmat4 toGlm(vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(&matrix->Element[0][0])); // VTK's elements go row by row
}

//------------------------------------------------------------------------------
const std::vector<SurfaceCells>& cellsOf(const DrawnBlock& block)
{
  static const std::vector<SurfaceCells> spheres = { SurfaceCells::Spheres };
  static const std::vector<SurfaceCells> sticks = { SurfaceCells::Sticks };
  static const auto mixtures = []
  {
    std::array<std::vector<SurfaceCells>, 8> lists;
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      if (i & 1)
      {
        lists[i] = { SurfaceCells::Polygons, SurfaceCells::Strips };
      }
      if (i & 2)
      {
        lists[i].push_back(SurfaceCells::PointSpheres);
      }
      if (i & 4)
      {
        lists[i].push_back(SurfaceCells::LineTubes);
      }
    }
    return lists;
  }();
  if (block.solids)
  {
    return block.solidCells == SurfaceCells::Spheres ? spheres : sticks;
  }
  return mixtures[(block.drawsTriangles ? 1u : 0u) |
    (block.pointRadiusFromWorld != glm::dvec4(0.0) ? 2u : 0u) |
    (block.lineRadiusFromWorld != glm::dvec4(0.0) ? 4u : 0u)];
}

//------------------------------------------------------------------------------
glm::dvec4 radiusFromWorld(const DrawnBlock& block, SurfaceCells cells)
{
  return cells == SurfaceCells::PointSpheres ? block.pointRadiusFromWorld
    : cells == SurfaceCells::LineTubes       ? block.lineRadiusFromWorld
                                             : glm::dvec4(0.0);
}

//------------------------------------------------------------------------------
DrawnProps findDrawnProps(vtkRenderer* renderer, PropMemory& memory)
{
  memory.plainProps.beginFrame();
  memory.cutouts.beginFrame();
  memory.images.beginFrame();
  Finder finder(renderer, memory);
  vtkPropCollection* viewProps = renderer->GetViewProps();
  vtkCollectionSimpleIterator cookie;
  viewProps->InitTraversal(cookie);
  int number = 0;
  while (vtkProp* viewProp = viewProps->GetNextProp(cookie))
  {
    finder.addViewProp(viewProp, number++);
  }
  memory.plainProps.endFrame();
  return finder.take();
}

} // namespace gnomon
