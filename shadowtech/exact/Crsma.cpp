#include "shadowtech/exact/Crsma.h"

namespace gnomon
{

//------------------------------------------------------------------------------
MapRule Crsma::rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const
{
  return certainRule(
    settings.adjacencyRing == AdjacencyRing::Vertices ? Covering::Fan : Covering::Ring, gpu);
}

//------------------------------------------------------------------------------
TechniqueInfo Crsma::info()
{
  TechniqueInfo info = infoOf("crsma");
  info.asPublished = "crsma_as_published";
  return info;
}

} // namespace gnomon
