#pragma once

#include "lights/Bounds.h"
#include "plugin/scene/KeptInstances.h"
#include "plugin/scene/MapperInternals.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// @file
/// Where the solids of impostor mappers are, as VTK's shaders place them: an actor's matrix moves
/// and turns them, and leaves their radii and lengths as they are.

/// The solids of a polydata, one for each of its points. Those without a size are left out.
PlacedInstances placeSolids(const DrawnSolids& drawn, vtkPolyData* data,
  const glm::dmat4& worldFromModel, const glm::dvec3& centreWorld);

/// The box around them where no matrix moves them.
Bounds boundsOfSolids(const DrawnSolids& drawn, vtkPolyData* data);

} // namespace gnomon
