#pragma once

#include "lights/SettingsTable.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <string>

namespace gnomon::tool
{

/// Return a check that a text is one of these values (CLI::Option::check()).
std::function<std::string(const std::string&)> isOneOf(const SettingValues& values);

/// Return a setting's option: "--kernel-size" for "kernel_size".
std::string optionOf(std::string settingName);

/// Return a setting's help: "the kernel's width (texels): an integer in [1, 32]; default 3".
std::string helpOf(const Setting& setting);

/// Return a table's title with the techniques that have it: "The filter's kernel (pcf)".
std::string headingOf(const SettingsTable& table);

/// Add an option for every setting of a light's shadows to a command. Options refuse invalid
/// values.
/// @param values receives values by the settings' names, empty for missing options; must outlive
/// the command
/// @param without settings for which the command has its own options
void addSettingOptions(CLI::App& command, std::map<std::string, std::string>& values,
  const std::vector<std::string>& without = {});

} // namespace gnomon::tool
