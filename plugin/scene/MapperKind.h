#pragma once

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkMapper;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// How a mapper says what it draws.
enum class MapperKind
{
  PlainPolyData, ///< vtkOpenGLPolyDataMapper itself: nearly every mapper
  PolyData,      ///< a class derived from it
  DataSet,       ///< by a polydata mapper inside
  Composite,     ///< blocks of composite data, out of buffers that they share
  Parts,         ///< blocks of composite data, by a polydata mapper for each
  Glyphs,
  Solids,   ///< a polydata mapper by type, which draws a solid at each point in place of the cells
  Molecule, ///< by mappers of solids
  Splats,   ///< a polydata mapper by type, which draws flat pictures at points
  Other
};

/// Asked once for each prop: VTK's casts compare with all base classes.
MapperKind kindOf(vtkMapper* mapper);

/// Runs the pipeline before a mapper, as when it draws.
void runInput(vtkMapper* mapper, MapperKind kind);

/// Why the snapshot cannot hold what a mapper draws; null if it can.
const char* reasonAgainst(vtkMapper* mapper, MapperKind kind);

/// A mapper's clipping planes, as many as VTK applies: in world coordinates, (n, d), n.x + d >= 0
/// where it draws.
std::vector<glm::dvec4> clipPlanesOf(vtkAbstractMapper* mapper);

} // namespace gnomon
