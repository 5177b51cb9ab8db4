#include "lights/ViewSettings.h"

#include "lights/SettingsTable.h"
#include "lights/Splits.h"

namespace gnomon
{

//------------------------------------------------------------------------------
const SettingsTable& viewSettings()
{
  using S = ViewSettings;
  static const SettingsTable table = { "The map",
    {
      bakedInto(integer(
        "map_size", "the side of a light's map", "texels", &S::mapSizeTexels, { 16, 16384 })),
      choice("projection", "how the light's view is laid onto its map", &S::projection,
        { "technique", "uniform", "lispsm", "tsm", "pssm", "cube" }),
      choice("fit",
        "what uniform views are fitted to: all casters, or what the camera sees, once or in every "
        "frame",
        &S::fit, { "off", "once", "frame" }),
      choice("snap", "whether fitted views move by whole texels", &S::snap, { "off", "on" }),
      integer("splits", "the number of pssm's views", "", &S::splits, { 1, mostSplits }),
      real("split_lambda", "where pssm splits: 0 uniform, 1 logarithmic", "", &S::splitLambda,
        { 0.0, 1.0 }),
      real("split_blend", "the share of a split in which it is blended into the next", "",
        &S::splitBlend, { 0.0, 0.5 }),
    } };
  return table;
}

} // namespace gnomon
