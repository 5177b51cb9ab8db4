#pragma once

#include "lights/Bounds.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/KeptInstances.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// @file
/// Where the solids of impostor mappers are, as VTK's shaders place them: an actor's matrix moves
/// and turns them, and leaves their radii and lengths as they are.

/// The solids of a block, in the order in which VTK draws them. Those without a size are left out,
/// and those whose middle a plane cuts off. A tube has the radius of its middle all along.
/// @param cells solids
/// @param clipPlanes in world coordinates, as DrawnProp has them
PlacedInstances placeSolids(const DrawnBlock& block, SurfaceCells cells,
  const glm::dmat4& worldFromModel, const std::vector<glm::dvec4>& clipPlanes,
  const glm::dvec3& centreWorld);

/// The box around them where no matrix moves them; around their middles alone where the camera says
/// how large they are.
Bounds boundsOfSolids(const DrawnBlock& block, SurfaceCells cells);

} // namespace gnomon
