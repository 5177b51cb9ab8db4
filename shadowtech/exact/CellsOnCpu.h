#pragma once

#include "shadowtech/exact/MapCasters.h"

namespace gnomon
{

/// Bake a conservative map's cells on all cores of the CPU, in bands of rows.
/// @param size side of the map, in texels
/// @param take called with each finished cell
/// @return false if a caster is so near to the light that nothing is certain; `take` is not called
/// then
bool drawCellsOnCpu(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
  const TakeCell& take);

} // namespace gnomon
