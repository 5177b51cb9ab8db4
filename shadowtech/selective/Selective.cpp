#include "shadowtech/selective/Selective.h"

namespace gnomon
{
namespace
{

std::string refusedBySelective(const ShadowLight& light)
{
  if (light.contourPixels == 0 && light.outside == OutsideContour::Check)
  {
    return "nothing is outside of a 'contour' that is the whole image; 'outside' is for those of "
           "2, 4 and 6 pixels";
  }
  return light.leftovers == Leftovers::Lit && light.coherenceTexels == 0 &&
      light.neighbourTexels == 0 && light.adjacency == Adjacency::Off
    ? "without 'coherence', 'neighbours' and 'adjacency' nothing decides pixels of the contour, "
      "and with 'leftovers' lit all of them would be lit"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Selective::info()
{
  TechniqueInfo info = infoOf("selective");
  info.refused = refusedBySelective;
  return info;
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
