#include "shadowtech/exact/Silhouette.h"

namespace gnomon
{

//------------------------------------------------------------------------------
MapRule Silhouette::rule(const ShadowSettings&, const CellsOnGpu*) const
{
  return certainRule(Covering::Silhouette);
}

//------------------------------------------------------------------------------
TechniqueInfo Silhouette::info()
{
  TechniqueInfo info = infoOf("silhouette");
  info.onlyCpuDraws = "parts of the casters' surface are drawn one after another";
  return info;
}

} // namespace gnomon
