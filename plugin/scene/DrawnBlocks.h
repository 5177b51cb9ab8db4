#pragma once

#include "plugin/scene/ActorInternals.h"
#include "plugin/scene/MapperKind.h"
#include "plugin/scene/SurfaceExtraction.h"

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkDataArray;
class vtkDataSet;
class vtkMapper;
class vtkObjectBase;
class vtkPolyData;
class vtkProp;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct DrawnProp;

/// One polydata of a prop. VTK draws it once where the prop is, or many times as a glyph.
struct DrawnBlock
{
  vtkPolyData* data = nullptr;
  vtkDataSet* glyphPoints = nullptr; ///< for a glyph: the points at which VTK draws it
  int glyphSource = 0;               ///< for a glyph: its index in the mapper's table of sources
  vtkPolyData* drawnAs = nullptr;    ///< VTK draws it in the data's place; null: the data itself
  vtkMapper* solids = nullptr;       ///< the mapper, if it draws a solid at each point and no cells
  SurfaceCells solidCells = SurfaceCells::Spheres; ///< kind of these solids
  ///@{
  /// Radius of spheres at vertex cells and of tubes along lines: an affine function of the world
  /// position, as each has a constant number of pixels. Zero if VTK draws none.
  glm::dvec4 pointRadiusFromWorld{ 0.0 };
  glm::dvec4 lineRadiusFromWorld{ 0.0 };
  ///@}
  bool drawsTriangles = true; ///< true if VTK draws polygons and strips as such
  /// The points' normals if VTK shades triangles with them; else null.
  vtkDataArray* normals = nullptr;
  /// Coordinates of the texture that cuts holes into it; null if none does.
  vtkDataArray* textureCoordinates = nullptr;
};

/// Return the radius of cells that are sized in pixels; zero for others.
glm::dvec4 radiusFromWorld(const DrawnBlock& block, SurfaceCells cells);

/// Return the kinds of cells that VTK draws of a block.
const std::vector<SurfaceCells>& cellsOf(const DrawnBlock& block);

/// Set the normals with which VTK shades a block's triangles. Flat or unlit properties have none.
/// The caller skips props whose vertices a user's shader code may move.
void takeNormals(vtkActor* actor, DrawnBlock& block);

/// An actor that VTK draws, and how.
struct DrawnActor
{
  vtkActor* actor;
  ActorDrawing drawing;
  vtkMapper* mapper = nullptr; ///< draws the polydata
  MapperKind kind = MapperKind::Other;
  bool lit = false;         ///< showsLight()
  bool copies = false;      ///< hasOwnFramebuffer()
  bool seenThrough = false; ///< isSeenThrough(), or it copies
};

/// Lists the blocks that mappers draw, with their inputs up to date.
class BlockFinder
{
public:
  /// @param blocks receives them
  /// @param skip called for what the snapshot cannot hold, with the reason
  BlockFinder(vtkRenderer* renderer, std::vector<DrawnBlock>& blocks,
    std::function<void(vtkObjectBase* what, const char* why)> skip)
    : renderer_(renderer)
    , blocks_(blocks)
    , skip_(std::move(skip))
  {
  }

  /// Update the input of a view prop's mapper.
  /// @param kind of the mapper; set to that of the returned one
  /// @return the mapper that draws the polydata; null if VTK draws nothing, or the snapshot cannot
  /// hold it
  vtkMapper* update(vtkProp* viewProp, vtkMapper* mapper, MapperKind& kind);

  /// Add the blocks that an actor draws in one of the two passes, if any of them has surfaces.
  /// @param prop the pass, and what VTK does with the blocks
  /// @param texture the name of its cut-out's texture
  /// @return their number
  std::size_t add(const DrawnActor& drawn, const DrawnProp& prop, const std::string& texture);

private:
  bool updateInput(vtkMapper* mapper, MapperKind kind);
  void addAll(const DrawnActor& drawn, const DrawnProp& prop);
  void addSolids(vtkMapper* mapper, const glm::dmat4& worldFromModel);
  void takePixelSizes(vtkActor* actor, DrawnBlock& block);

  vtkRenderer* renderer_;
  std::vector<DrawnBlock>& blocks_;
  std::function<void(vtkObjectBase*, const char*)> skip_;
  std::unordered_set<vtkMapper*> updated_;
};

} // namespace gnomon
