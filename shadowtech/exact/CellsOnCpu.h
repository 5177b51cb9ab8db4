#pragma once

#include "shadowtech/exact/MapCasters.h"

namespace gnomon
{

/// Draws a conservative map's cells on the CPU, in bands of rows, on all cores.
/// @param size of the map, in texels
/// @return false where a caster is so near to the light that nothing is certain: nothing is drawn
bool drawCellsOnCpu(const CasterScene& scene, const CasterEdges& edges, int size, Covering covering,
  const TakeCell& take);

} // namespace gnomon
