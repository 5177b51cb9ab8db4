#include "shadowtech/crsm/Crsm.h"

#include "shadowtech/conservative/PublishedMap.h"

namespace gnomon
{

//------------------------------------------------------------------------------
MapRule Crsm::rule(const ShadowSettings&, const CellsOnGpu* gpu) const
{
  return certainRule(Covering::Triangle, gpu);
}

//------------------------------------------------------------------------------
TechniqueInfo Crsm::info()
{
  TechniqueInfo info = infoOf("crsm");
  info.asPublished = "crsm_as_published";
  return info;
}

//------------------------------------------------------------------------------
MapRule CrsmAsPublished::rule(const ShadowSettings&, const CellsOnGpu*) const
{
  return publishedRule(PublishedLayers::Crsm);
}

//------------------------------------------------------------------------------
TechniqueInfo CrsmAsPublished::info()
{
  TechniqueInfo info = infoOf("crsm_as_published");
  info.asPublished = info.name;
  info.exact = false;
  info.mapIsOptional = false;
  info.onlyCpuDraws = onlyCpuDrawsPublished;
  return info;
}

} // namespace gnomon
