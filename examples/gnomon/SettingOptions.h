#pragma once

#include "lights/SettingsTable.h"

#include <CLI/CLI.hpp>

#include <map>
#include <string>

namespace gnomon::tool
{

/// The option of a setting: "--kernel-size" for "kernel_size".
std::string optionOf(std::string settingName);

/// Its value by default; empty where there is none.
std::string defaultOf(const Setting& setting);

/// "the kernel's width (texels): an integer in [1, 32]; default 3"
std::string helpOf(const Setting& setting);

/// A table's title with the techniques that have it: "The filter's kernel (pcf)".
std::string headingOf(const SettingsTable& table);

/// Gives a command an option for every setting of a light's shadows, which refuses what the setting
/// does not take.
/// @param values by the settings' names; empty where the command line says nothing. Must outlive
/// the command
/// @param without settings that the command has its own options for
void addSettingOptions(CLI::App& command, std::map<std::string, std::string>& values,
  const std::vector<std::string>& without = {});

/// Gives a command the option "--tracer".
/// @param tracer a vtkGnomonShadowPass::TracerType. Must outlive the command
void addTracerOption(CLI::App& command, int& tracer);

/// Gives a command the option "--rasterizer".
/// @param rasterizer a vtkGnomonShadowPass::RasterizerType. Must outlive the command
void addRasterizerOption(CLI::App& command, int& rasterizer);

} // namespace gnomon::tool
