#include "shadowtech/exact/Crsm.h"

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

} // namespace gnomon
