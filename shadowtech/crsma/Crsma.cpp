#include "shadowtech/crsma/Crsma.h"

#include "shadowtech/conservative/PublishedMap.h"

namespace gnomon
{

//------------------------------------------------------------------------------
MapRule Crsma::rule(const ShadowSettings& settings) const
{
  return certainRule(
    settings.adjacencyRing == AdjacencyRing::Vertices ? Covering::Fan : Covering::Ring);
}

//------------------------------------------------------------------------------
TechniqueInfo Crsma::info()
{
  TechniqueInfo info = infoOf("crsma");
  info.asPublished = "crsma_as_published";
  return info;
}

//------------------------------------------------------------------------------
MapRule CrsmaAsPublished::rule(const ShadowSettings&) const
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
  info.mapIsOptional = false;
  return info;
}

} // namespace gnomon
