#include "shadowtech/selective/Selective.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Selective::info()
{
  return infoOf("selective");
}

//------------------------------------------------------------------------------
ChainStages Selective::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.contourPixels = settings.contourPixels;
  stages.outside = settings.outside;
  stages.coherenceTexels = settings.coherenceTexels;
  stages.neighbourTexels = settings.neighbourTexels;
  stages.adjacency = settings.adjacency;
  stages.leftovers = settings.leftovers;
  return stages;
}

} // namespace gnomon
