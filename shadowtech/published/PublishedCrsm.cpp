#include "shadowtech/published/PublishedCrsm.h"

#include "shadowtech/published/PublishedMap.h"

namespace gnomon
{
namespace
{

/// @param info of maps whose rule is never wrong
TechniqueInfo asPublished(TechniqueInfo info)
{
  info.asPublished = info.name;
  info.exact = false;
  info.mapIsOptional = false;
  info.onlyCpuDraws = onlyCpuDrawsPublished;
  return info;
}

} // namespace

//------------------------------------------------------------------------------
MapRule CrsmAsPublished::rule(const ShadowSettings&, const CellsOnGpu*) const
{
  return publishedRule(PublishedLayers::Crsm);
}

//------------------------------------------------------------------------------
TechniqueInfo CrsmAsPublished::info()
{
  return asPublished(infoOf("crsm_as_published"));
}

//------------------------------------------------------------------------------
MapRule CrsmaAsPublished::rule(const ShadowSettings&, const CellsOnGpu*) const
{
  return publishedRule(PublishedLayers::Crsma);
}

//------------------------------------------------------------------------------
TechniqueInfo CrsmaAsPublished::info()
{
  return asPublished(infoOf("crsma_as_published"));
}

} // namespace gnomon
