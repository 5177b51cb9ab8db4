#include "shadowtech/selective/Selective.h"

namespace gnomon
{
namespace
{

std::string refusedBySelective(const ShadowLight& light)
{
  if (light.chain.contourPixels == 0 && light.chain.outside == OutsideContour::Check)
  {
    return "nothing is outside a 'contour' that is the whole image; 'outside' needs a contour of "
           "2, 4 or 6 pixels";
  }
  return light.chain.leftovers == Leftovers::Lit && light.coherence.texels == 0 &&
      light.chain.neighbourTexels == 0 && light.chain.adjacency == Adjacency::Off
    ? "without 'coherence', 'neighbours' and 'adjacency' nothing decides pixels of the contour, "
      "and with 'leftovers' lit all of them would be lit"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Selective::info()
{
  TechniqueInfo info = infoOf("selective");
  info.settings.push_back(&chainSettings());
  info.refused = { refusedBySelective };
  return info;
}

//------------------------------------------------------------------------------
ChainStages Selective::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.contourPixels = settings.chain.contourPixels;
  stages.outside = settings.chain.outside;
  stages.coherenceTexels = settings.coherence.texels;
  stages.neighbourTexels = settings.chain.neighbourTexels;
  stages.adjacency = settings.chain.adjacency;
  stages.leftovers = settings.chain.leftovers;
  return stages;
}

} // namespace gnomon
