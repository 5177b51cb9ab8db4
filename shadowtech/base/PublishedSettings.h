#pragma once

#include "lights/SettingsTable.h"

namespace gnomon
{

/// Return the settings of techniques with a variant by the letter of a publication
/// (TechniqueInfo::asPublished).
inline const SettingsTable& publishedSettings()
{
  static const SettingsTable table = { "Publications",
    { choice("as_published", "by the letter of its publication, which is not right",
      &ShadowSettings::asPublished, { "off", "on" }) } };
  return table;
}

} // namespace gnomon
