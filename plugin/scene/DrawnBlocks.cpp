#include "plugin/scene/DrawnBlocks.h"

#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/GlyphInstances.h"
#include "plugin/scene/MapperInternals.h"
#include "plugin/scene/SolidSizes.h"
#include "plugin/scene/SplatSpheres.h"
#include "plugin/scene/TextureCutouts.h"

#include "vtkActor.h"
#include "vtkDataSetMapper.h"
#include "vtkGlyph3DMapper.h"
#include "vtkMath.h"
#include "vtkOpenGLMoleculeMapper.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon
{
namespace
{

/// Return a block of solids at the points of a polydata.
DrawnBlock solidsBlock(vtkMapper* mapper, vtkPolyData* data, SurfaceCells cells)
{
  DrawnBlock block;
  block.data = data;
  block.solids = mapper;
  block.solidCells = cells;
  return block;
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

} // namespace

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

glm::dvec4 radiusFromWorld(const DrawnBlock& block, SurfaceCells cells)
{
  return cells == SurfaceCells::PointSpheres ? block.pointRadiusFromWorld
    : cells == SurfaceCells::LineTubes       ? block.lineRadiusFromWorld
                                             : glm::dvec4(0.0);
}

void takeNormals(vtkActor* actor, DrawnBlock& block)
{
  if (actor->GetProperty()->GetInterpolation() != VTK_FLAT && actor->GetProperty()->GetLighting())
  {
    block.normals = block.data->GetPointData()->GetNormals();
  }
}

vtkMapper* BlockFinder::update(vtkProp* viewProp, vtkMapper* mapper, MapperKind& kind)
{
  if (const char* reason = reasonAgainst(mapper, kind))
  {
    this->skip_(mapper, reason);
    return nullptr;
  }
  // VTK itself reports a mapper without input.
  if (!this->updateInput(mapper, kind) || isCulled(viewProp, mapper, kind))
  {
    return nullptr;
  }
  if (kind == MapperKind::DataSet)
  {
    mapper = innerMapper(static_cast<vtkDataSetMapper*>(mapper));
    kind = MapperKind::PolyData;
    this->updateInput(mapper, kind);
  }
  return mapper;
}

std::size_t BlockFinder::add(
  const DrawnActor& drawn, const DrawnProp& prop, const std::string& texture)
{
  std::vector<DrawnBlock>& blocks = this->blocks_;
  const std::size_t before = blocks.size();
  this->addAll(drawn, prop);
  const auto first = blocks.begin() + static_cast<std::ptrdiff_t>(before);
  if (std::none_of(first, blocks.end(), hasSurfaces))
  {
    if (drawn.lit && std::any_of(first, blocks.end(), hasLinesOrPoints))
    {
      this->skip_(drawn.mapper, "lines or points");
    }
    blocks.resize(before);
  }
  for (std::size_t i = before; i < blocks.size(); ++i)
  {
    if (prop.cutout)
    {
      blocks[i].textureCoordinates = textureCoordinates(drawn.mapper, texture, blocks[i].data);
    }
    if (!prop.isMoved)
    {
      takeNormals(drawn.actor, blocks[i]);
    }
  }
  return blocks.size() - before;
}

void BlockFinder::addAll(const DrawnActor& drawn, const DrawnProp& prop)
{
  vtkMapper* const mapper = drawn.mapper;
  const MapperKind kind = drawn.kind;
  if (kind == MapperKind::Composite || kind == MapperKind::Parts)
  {
    for (vtkPolyData* data : drawnBlocks(drawn.actor, mapper, prop.translucent))
    {
      this->blocks_.push_back({ data });
      if (kind == MapperKind::Composite)
      {
        this->takePixelSizes(drawn.actor, this->blocks_.back());
      }
    }
  }
  else if (kind == MapperKind::Solids)
  {
    this->addSolids(mapper, prop.worldFromModel);
  }
  else if (kind == MapperKind::Molecule)
  {
    for (vtkMapper* solids : solidMappers(static_cast<vtkOpenGLMoleculeMapper*>(mapper)))
    {
      if (this->updateInput(solids, MapperKind::Solids))
      {
        this->addSolids(solids, prop.worldFromModel);
      }
    }
  }
  else if (kind == MapperKind::Splats)
  {
    for (vtkPolyData* data : splatBlocks(static_cast<vtkPointGaussianMapper*>(mapper)))
    {
      this->blocks_.push_back(solidsBlock(mapper, data, SurfaceCells::Spheres));
    }
  }
  else if (kind == MapperKind::Glyphs)
  {
    for (const Glyph& glyph : drawnGlyphs(static_cast<vtkGlyph3DMapper*>(mapper)))
    {
      this->blocks_.push_back({ glyph.data, glyph.points, glyph.source });
    }
  }
  else if (vtkPolyData* data = static_cast<vtkPolyDataMapper*>(mapper)->GetInput())
  {
    this->blocks_.push_back({ data });
    this->takePixelSizes(drawn.actor, this->blocks_.back());
  }
}

void BlockFinder::addSolids(vtkMapper* mapper, const glm::dmat4& worldFromModel)
{
  const std::optional<DrawnSolids> drawn = drawnSolids(mapper);
  if (const char* reason = reasonAgainstSolids(drawn, mapper, worldFromModel))
  {
    this->skip_(mapper, reason);
    return;
  }
  this->blocks_.push_back(
    solidsBlock(mapper, static_cast<vtkPolyDataMapper*>(mapper)->GetInput(), drawn->cells));
}

/// Store the radii of spheres at vertices and tubes along lines in a block of the actor's.
void BlockFinder::takePixelSizes(vtkActor* actor, DrawnBlock& block)
{
  vtkProperty* property = actor->GetProperty();
  if (!isSizedInPixels(property))
  {
    return;
  }
  const PixelSizes sizes = pixelSizes(property, this->renderer_);
  const bool surface = property->GetRepresentation() == VTK_SURFACE;
  block.pointRadiusFromWorld = sizes.pointRadiusFromWorld;
  block.lineRadiusFromWorld = surface ? sizes.lineRadiusFromWorld : glm::dvec4(0.0);
  block.drawsTriangles = surface;
  if (!surface && block.data->GetNumberOfCells() > block.data->GetNumberOfVerts())
  {
    this->skip_(actor, "corners of lines and polygons as points");
  }
}

/// Update a mapper's input.
/// @return true if there is any
bool BlockFinder::updateInput(vtkMapper* mapper, MapperKind kind)
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

} // namespace gnomon
