#include "shadowtech/selective/Coherence.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Coherence::info()
{
  return infoOf("coherence");
}

//------------------------------------------------------------------------------
ChainStages Coherence::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.coherenceTexels = settings.coherenceTexels;
  return stages;
}

} // namespace gnomon
