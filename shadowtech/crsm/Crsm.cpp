#include "shadowtech/crsm/Crsm.h"

namespace gnomon
{

//------------------------------------------------------------------------------
Crsm::Crsm()
  : ConservativeTechnique(Covering::Triangle)
{
}

//------------------------------------------------------------------------------
TechniqueInfo Crsm::info()
{
  return infoOf("crsm");
}

} // namespace gnomon
