#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// When a stale map is baked, if the technique works without it.
enum class BakeTime
{
  Settled, ///< after some frames without changes to its inputs (BakeBackoff)
  Always   ///< at once
};
/// The settings of optional maps.
struct BakeSettings
{
  BakeTime time = BakeTime::Settled;
};

/// Return the settings of techniques whose map is optional.
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
