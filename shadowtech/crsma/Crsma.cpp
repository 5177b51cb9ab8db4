#include "shadowtech/crsma/Crsma.h"

namespace gnomon
{

//------------------------------------------------------------------------------
Crsma::Crsma()
  : ConservativeTechnique(Covering::Ring)
{
}

//------------------------------------------------------------------------------
TechniqueInfo Crsma::info()
{
  return infoOf("crsma");
}

} // namespace gnomon
