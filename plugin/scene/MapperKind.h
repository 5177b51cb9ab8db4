#pragma once

#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkActor;
class vtkMapper;
class vtkProperty;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The kinds of mappers, by how they expose their surfaces.
enum class MapperKind
{
  PlainPolyData, ///< vtkOpenGLPolyDataMapper itself: nearly every mapper
  PolyData,      ///< a class derived from it
  DataSet,       ///< by a polydata mapper inside
  Composite,     ///< blocks of composite data, from shared buffers
  Parts,         ///< blocks of composite data, by a polydata mapper for each
  Glyphs,
  Solids,   ///< a polydata mapper by type, which draws a solid at each point instead of the cells
  Molecule, ///< by mappers of solids
  Splats,   ///< a polydata mapper by type, which draws flat pictures at points
  Other
};

/// Return a mapper's kind. Called once per prop: VTK's casts compare with all base classes.
MapperKind kindOf(vtkMapper* mapper);

/// True if a mapper draws surfaces for a property. Solids, molecules and splats look alike as a
/// surface, as a wireframe and as points; other mappers go by the representation.
bool drawnAsSurface(vtkProperty* property, vtkMapper* mapper);

/// True if VTK blends surfaces of an actor over what was drawn before, yet in the opaque pass:
/// ForceOpaqueOn with an opacity below 1, of the property, of scalars or of blocks. Textures do not
/// count: their holes are in the snapshot (TextureCutouts.h).
bool isSeenThrough(vtkActor* actor);

/// True if a mapper draws into a framebuffer of its own and copies from there. Its shaders write to
/// that one, so the receivers cannot have its pixels.
bool hasOwnFramebuffer(vtkMapper* mapper);

/// True if a user's code changes the shaders that place an actor's vertices.
bool mayMoveVertices(vtkActor* actor);

/// True if a light changes how a prop looks. The outlines that VTK's interactor styles put around
/// what is picked reflect nothing.
bool showsLight(vtkProperty* property);

/// Run the pipeline before a mapper, as when it draws.
void runInput(vtkMapper* mapper, MapperKind kind);

/// Return why the snapshot cannot hold a mapper's surfaces; null if it can.
const char* reasonAgainst(vtkMapper* mapper, MapperKind kind);

/// Return a mapper's clipping planes in world coordinates, as many as VTK applies. For a plane (n,
/// d), VTK draws where n.x + d >= 0.
std::vector<glm::dvec4> clipPlanesOf(vtkAbstractMapper* mapper);

} // namespace gnomon
