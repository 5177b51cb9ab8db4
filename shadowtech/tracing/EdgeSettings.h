#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// The smoothness of hard shadows' edges.
struct EdgeSettings
{
  int samples = 1; ///< rays of a pixel at an edge
};

/// Return the settings of techniques that trace single pixels.
inline const SettingsTable& edgeSettings()
{
  static const SettingsTable table = { "Edges of hard shadows",
    { oneOf("edge_samples",
      "shadow rays of a pixel at an edge: more than one smooth the edges of hard shadows", "",
      &EdgeSettings::samples, { { "1", 1 }, { "4", 4 }, { "16", 16 }, { "64", 64 } }) } };
  return table;
}

} // namespace gnomon
