#include "shadowtech/crsma/Crsma.h"

#include "shadowtech/conservative/PublishedMap.h"

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

//------------------------------------------------------------------------------
MapRule CrsmaAsPublished::rule(const ShadowSettings&, const CellsOnGpu*) const
{
  return publishedRule(PublishedLayers::Crsma);
}

//------------------------------------------------------------------------------
TechniqueInfo CrsmaAsPublished::info()
{
  TechniqueInfo info = infoOf("crsma_as_published");
  info.asPublished = info.name;
  info.exact = false;
  info.mapIsOptional = false;
  info.onlyCpuDraws = onlyCpuDrawsPublished;
  return info;
}

} // namespace gnomon
