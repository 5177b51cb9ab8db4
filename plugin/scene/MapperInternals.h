#pragma once

#include "plugin/scene/SurfaceExtraction.h"
#include "plugin/vtk_versions/CompositeMappers.h"

#include "lights/vtkGnomonVersions.h"

#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkDataSetMapper;
class vtkFloatArray;
class vtkMapper;
class vtkOpenGLMoleculeMapper;
class vtkPolyData;
class vtkPolyDataMapper;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return the cells that a polydata mapper is about to draw with the program that it has just
/// handed to a render pass (vtkOpenGLRenderPass::SetShaderParameters). They are drawn as triangles,
/// or are vertices and lines, as solids or not. The mapper may be inside a mapper of composite
/// data. Nothing for selections and mappers that do not draw polydata.
std::optional<SurfaceCells> cellsAboutToBeDrawn(vtkAbstractMapper* mapper);

/// Return the draw calls for these cells, in order of firstPrimitive.
std::vector<DrawCall> drawCalls(vtkAbstractMapper* mapper, SurfaceCells cells);

/// Return the polydata mapper by which a vtkDataSetMapper draws, with its input. VTK makes it when
/// the outer mapper first draws, but a pass may ask earlier. The outer mapper must have an input.
vtkPolyDataMapper* innerMapper(vtkDataSetMapper* mapper);

/// How a mapper of impostors draws a solid at each point.
struct DrawnSolids
{
  SurfaceCells cells;
  float radius = 0.0f;             ///< if no array has it
  vtkFloatArray* scales = nullptr; ///< spheres: radii, or null; sticks: (length, radius, unused)
  vtkFloatArray* directions = nullptr; ///< of sticks
};
/// Return a mapper's solids; nothing if it draws none or VTK cannot read its arrays.
/// @param mapper whose input is up to date
std::optional<DrawnSolids> drawnSolids(vtkMapper* mapper);

/// Return the updated mappers by which a molecule mapper draws atoms and bonds, as far as it draws
/// them.
std::vector<vtkMapper*> solidMappers(vtkOpenGLMoleculeMapper* mapper);

/// Return the point array that a mapper was told to read a texture's coordinates from
/// (vtkPolyDataMapper::MapDataArrayToMultiTextureAttribute); null for the data's own.
const char* coordinatesArray(vtkAbstractMapper* mapper, const std::string& texture);

} // namespace gnomon
