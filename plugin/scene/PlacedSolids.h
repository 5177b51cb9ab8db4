#pragma once

#include "lights/Bounds.h"
#include "plugin/scene/DrawnProps.h"
#include "plugin/scene/KeptInstances.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// @file
/// Places the solids of impostor mappers like VTK's shaders: an actor's matrix moves and turns them
/// but leaves their radii and lengths.

/// Return the solids of a block, in VTK's order. Solids without a size are left out, and those with
/// the middle cut off by a plane. A tube has the radius of its middle along its whole length.
/// @param cells solids
/// @param clipPlanes in world coordinates, as in DrawnProp
PlacedInstances placeSolids(const DrawnBlock& block, SurfaceCells cells,
  const glm::dmat4& worldFromModel, const std::vector<glm::dvec4>& clipPlanes,
  const SceneFrame& frame);

/// Return the box around a block's solids in model coordinates. Solids sized by the camera count by
/// their middles alone.
Bounds boundsOfSolids(const DrawnBlock& block, SurfaceCells cells);

} // namespace gnomon
