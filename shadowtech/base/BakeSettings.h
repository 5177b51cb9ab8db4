#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// When a stale map is baked that a technique can do without.
enum class BakeTime
{
  Settled, ///< after some frames in which nothing that it depends on changed (BakeBackoff)
  Always   ///< at once
};
struct BakeSettings
{
  BakeTime time = BakeTime::Settled;
};

/// Of techniques whose map is optional.
inline const SettingsTable& bakeSettings()
{
  static const SettingsTable table = { "Optional maps",
    { choice("bake",
      "when a stale map is baked: after frames in which nothing changed, until when all is traced, "
      "or at once",
      &BakeSettings::time, { "settled", "always" }) } };
  return table;
}

} // namespace gnomon
