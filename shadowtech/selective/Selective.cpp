#include "shadowtech/selective/Selective.h"

namespace gnomon
{
namespace
{

std::string refusedBySelective(const ShadowLight& light)
{
  if (light.of<ChainSettings>().contourPixels == 0 &&
    light.of<ChainSettings>().outside == OutsideContour::Check)
  {
    return "nothing is outside a 'contour' that is the whole image; 'outside' needs a contour of "
           "2, 4 or 6 pixels";
  }
  return light.of<ChainSettings>().leftovers == Leftovers::Lit &&
      light.of<CoherenceSettings>().texels == 0 && light.of<ChainSettings>().neighbourTexels == 0 &&
      light.of<ChainSettings>().adjacency == Adjacency::Off
    ? "without 'coherence', 'neighbours' and 'adjacency' nothing decides pixels of the contour, "
      "and with 'leftovers' lit all of them would be lit"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
const SettingsTable& chainSettings()
{
  using S = ChainSettings;
  static const SettingsTable table = { "The chain of tests",
    {
      oneOf("contour", "how wide the contour between light and shadow is that is looked at",
        "pixels", &S::contourPixels, { { "2", 2 }, { "4", 4 }, { "6", 6 }, { "image", 0 } }),
      oneOf("neighbours", "of how many texels the triangles are met", "texels", &S::neighbourTexels,
        { { "off", 0 }, { "1", 1 }, { "4", 4 }, { "9", 9 } }),
      choice("adjacency",
        "which neighbours of its own texel's triangle are met: those across its edges, or all "
        "around its vertices",
        &S::adjacency, { "off", "edges", "vertices" }),
      choice("leftovers",
        "what becomes of what is still uncertain: traced, lit, or what most of nine texels say",
        &S::leftovers, { "trace", "lit", "majority" }),
      choice("outside",
        "outside of the contour, whether the map is believed, or looked at more closely where "
        "nine texels do not agree",
        &S::outside, { "map", "check" }),
    } };
  return table;
}

//------------------------------------------------------------------------------
TechniqueInfo Selective::info()
{
  TechniqueInfo info = infoOf("selective");
  info.settings.push_back(&chainSettings());
  info.refused = refusedBySelective;
  return info;
}

//------------------------------------------------------------------------------
ChainStages Selective::stagesOf(const ShadowSettings& settings) const
{
  ChainStages stages;
  stages.contourPixels = settings.of<ChainSettings>().contourPixels;
  stages.outside = settings.of<ChainSettings>().outside;
  stages.coherenceTexels = settings.of<CoherenceSettings>().texels;
  stages.neighbourTexels = settings.of<ChainSettings>().neighbourTexels;
  stages.adjacency = settings.of<ChainSettings>().adjacency;
  stages.leftovers = settings.of<ChainSettings>().leftovers;
  return stages;
}

} // namespace gnomon
