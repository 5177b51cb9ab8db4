#include "shadowtech/silhouette/Silhouette.h"

namespace gnomon
{

//------------------------------------------------------------------------------
MapRule Silhouette::rule(const ShadowSettings&) const
{
  return certainRule(Covering::Silhouette);
}

//------------------------------------------------------------------------------
TechniqueInfo Silhouette::info()
{
  return infoOf("silhouette");
}

} // namespace gnomon
