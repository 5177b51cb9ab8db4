#include "shadowtech/selective/Coherence.h"

#include "lights/LightSamples.h"

namespace gnomon
{
namespace
{

std::string refusedByCoherence(const ShadowLight& light)
{
  return light.coherence.texels == 0
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
  info.refused = { refusedByCoherence, refusedSamples };
  return info;
}

//------------------------------------------------------------------------------
ChainStages Coherence::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.coherenceTexels = settings.coherence.texels;
  stages.rimPoints = 7;
  return stages;
}

} // namespace gnomon
