#pragma once

#include "lights/SettingsTable.h"
#include "shadowtech/Registry.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <string>

namespace gnomon::tool
{

/// Return a check that a text is one of these values (CLI::Option::check()).
inline std::function<std::string(const std::string&)> isOneOf(const SettingValues& values)
{
  return [values](const std::string& text) {
    return readValue(values, text) ? "" : "found \"" + text + "\", expected " + expectedOf(values);
  };
}

/// Return a setting's option: "--kernel-size" for "kernel_size".
inline std::string optionOf(std::string settingName)
{
  std::replace(settingName.begin(), settingName.end(), '_', '-');
  return "--" + settingName;
}

/// Return a setting's help: "the kernel's width (texels): an integer in [1, 32]; default 3".
inline std::string helpOf(const Setting& setting)
{
  const std::string byDefault = defaultOf(setting);
  return setting.meaning + (setting.unit.empty() ? "" : " (" + setting.unit + ")") + ": " +
    setting.expected() + (byDefault.empty() ? "" : "; default " + byDefault);
}

/// Return a table's title with the techniques that have it: "The filter's kernel (pcf)".
inline std::string headingOf(const SettingsTable& table)
{
  const std::string techniques = techniquesWith(table);
  return techniques.empty() ? table.title : table.title + " (" + techniques + ")";
}

/// Add an option for every setting of a light's shadows to a command. Options refuse invalid
/// values.
/// @param values receives values by the settings' names, empty for missing options; must outlive
/// the command
/// @param without settings for which the command has its own options
inline void addSettingOptions(CLI::App& command, std::map<std::string, std::string>& values,
  const std::vector<std::string>& without = {})
{
  for (const SettingsTable* table : settingsTables())
  {
    for (const Setting& setting : table->settings)
    {
      if (std::find(without.begin(), without.end(), setting.name) != without.end())
      {
        continue;
      }
      command.add_option(optionOf(setting.name), values[setting.name], helpOf(setting))
        ->check(isOneOf(setting.values))
        ->option_text(" ")
        ->group(headingOf(*table));
    }
  }
}

} // namespace gnomon::tool
