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

/// Which cells a polydata mapper, or one inside a mapper of composite data, is about to draw as
/// triangles with the program that it has just handed to a render pass
/// (vtkOpenGLRenderPass::SetShaderParameters), or its vertices and lines, as solids or not.
/// Nothing for selections and mappers that do not draw polydata.
std::optional<SurfaceCells> cellsAboutToBeDrawn(vtkAbstractMapper* mapper);

/// The draw calls for these cells, in order of firstPrimitive.
std::vector<DrawCall> drawCalls(vtkAbstractMapper* mapper, SurfaceCells cells);

/// The polydata mapper by which a vtkDataSetMapper draws, with the input that it draws then. VTK
/// makes it when the other first draws; a pass may ask before. The other has an input.
vtkPolyDataMapper* innerMapper(vtkDataSetMapper* mapper);

/// How a mapper of impostors draws a solid at each point.
struct DrawnSolids
{
  SurfaceCells cells;
  float radius = 0.0f;             ///< where no array says it
  vtkFloatArray* scales = nullptr; ///< spheres: radii, or null; sticks: (length, radius, unused)
  vtkFloatArray* directions = nullptr; ///< of sticks
};
/// Nothing for a mapper that draws no solids, or whose arrays VTK cannot read.
/// @param mapper whose input is up to date
std::optional<DrawnSolids> drawnSolids(vtkMapper* mapper);

/// The mappers by which a molecule mapper draws atoms and bonds, up to date, as far as it draws
/// them.
std::vector<vtkMapper*> solidMappers(vtkOpenGLMoleculeMapper* mapper);

/// The point array that a mapper was told to read a texture's coordinates from
/// (vtkPolyDataMapper::MapDataArrayToMultiTextureAttribute); null for the data's own.
const char* coordinatesArray(vtkAbstractMapper* mapper, const std::string& texture);

} // namespace gnomon
