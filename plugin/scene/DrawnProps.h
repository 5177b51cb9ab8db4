#pragma once

#include "plugin/scene/SurfaceExtraction.h"

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkDataArray;
class vtkDataSet;
class vtkMapper;
class vtkMatrix4x4;
class vtkPolyData;
class vtkProp;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

struct CutoutMask;
struct PropMemory;

/// A VTK matrix as GLM's: the same transformation.
glm::dmat4 toGlm(vtkMatrix4x4* matrix);

/// One polydata of a prop, drawn once where the prop is, or as a glyph many times.
struct DrawnBlock
{
  vtkPolyData* data = nullptr;
  vtkDataSet* glyphPoints = nullptr; ///< for a glyph: the points that it is drawn at
  int glyphSource = 0;               ///< and its place in the mapper's table of sources
  vtkPolyData* drawnAs = nullptr;    ///< what VTK draws in its place; null: the data itself
  vtkMapper* solids = nullptr;       ///< the mapper, if it draws a solid at each point and no cells
  SurfaceCells solidCells = SurfaceCells::Spheres; ///< and which
  ///@{
  /// Where vertex cells are drawn as spheres, or lines as tubes: their radius, which is affine over
  /// the world, as the camera sees all in the same number of pixels. Zero where they are not.
  glm::dvec4 pointRadiusFromWorld{ 0.0 };
  glm::dvec4 lineRadiusFromWorld{ 0.0 };
  ///@}
  bool drawsTriangles = true; ///< whether polygons and strips are drawn as such
  /// The points' normals, where VTK shades triangles with them; else null.
  vtkDataArray* normals = nullptr;
  /// Of the texture that cuts holes into it; null where none does.
  vtkDataArray* textureCoordinates = nullptr;
};

/// One leaf prop on one path of a view prop, with the surfaces that VTK draws of it in the opaque
/// pass, or in the translucent one. Pointers are valid until the scene is next changed.
struct DrawnProp
{
  vtkProp* viewProp = nullptr; ///< the renderer's prop: the actor itself, or the assembly above it
  std::size_t path = 0;        ///< the path's number among the view prop's paths
  vtkActor* actor = nullptr;   ///< whom VTK hands to a render pass: followers and the like have one
  vtkMapper* mapper = nullptr;
  glm::dmat4 worldFromModel{ 1.0 };
  /// The mapper's clipping planes in world coordinates: (n, d), n.x + d >= 0 where it draws.
  std::vector<glm::dvec4> clipPlanes;

  bool casts = true;
  bool receives = true;
  bool oneSided = false;
  bool translucent = false; ///< it is here because it was asked to cast

  std::shared_ptr<const CutoutMask> cutout; ///< what a texture leaves of its blocks; null for all
  glm::mat4 textureTransform{ 1.0f };       ///< of the cut-out's coordinates (s, t, 0, 1)

  std::size_t firstBlock = 0; ///< into DrawnProps::blocks
  std::size_t blockCount = 0;
};

struct DrawnProps
{
  std::vector<DrawnProp> props;
  /// What the props draw: one for vtkPolyDataMapper and vtkDataSetMapper, any number for mappers of
  /// composite data, where each polydata is there once, and for vtkGlyph3DMapper; atoms and bonds
  /// for vtkMoleculeMapper.
  std::vector<DrawnBlock> blocks;
  /// Actors whose translucent surfaces receive: whom VTK hands to a render pass.
  std::vector<const vtkProp*> translucentReceivers;
  /// Kinds of props that are visible and lit, and yet left out, each once.
  std::vector<std::string> leftOut;
  /// The same with how many they are, and what shadows do not show of the others, each a sentence.
  std::vector<std::string> notes;
};

/// The radius of what is sized in pixels; zero of all else.
glm::dvec4 radiusFromWorld(const DrawnBlock& block, SurfaceCells cells);

/// What VTK draws of a block.
const std::vector<SurfaceCells>& cellsOf(const DrawnBlock& block);

/// Lists what a renderer's opaque pass draws as surfaces, and the translucent surfaces that are
/// asked to cast, in the camera's view or not. Brings the inputs of mappers up to date first, as
/// VTK does when it draws.
///
/// @param memory the same for all frames of the renderer
DrawnProps findDrawnProps(vtkRenderer* renderer, PropMemory& memory);

} // namespace gnomon
