#include "shadowtech/silhouette/Silhouette.h"

namespace gnomon
{

//------------------------------------------------------------------------------
Silhouette::Silhouette()
  : ConservativeTechnique(Covering::Silhouette)
{
}

//------------------------------------------------------------------------------
TechniqueInfo Silhouette::info()
{
  return infoOf("silhouette");
}

} // namespace gnomon
