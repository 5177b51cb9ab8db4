#include "shadowtech/selective/Coherence.h"

namespace gnomon
{
namespace
{

std::string refusedByCoherence(const ShadowLight& light)
{
  return light.of<CoherenceSettings>().texels == 0
    ? "'coherence' decides pixels by texels that agree, and without that traces all of them, as "
      "'raytraced' does; its setting 'coherence' takes 4 or 9"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Coherence::info()
{
  TechniqueInfo info = infoOf("coherence");
  info.settings.push_back(&lightSampleSettings());
  info.settings.push_back(&lightSeedSettings());
  info.seesTextures = true;
  info.refused = refusedByCoherence;
  return info;
}

//------------------------------------------------------------------------------
ChainStages Coherence::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.coherenceTexels = settings.of<CoherenceSettings>().texels;
  stages.rimPoints = 7;
  return stages;
}

} // namespace gnomon
