#include "SettingOptions.h"

#include "shadowtech/Registry.h"

#include <algorithm>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
std::function<std::string(const std::string&)> isOneOf(const SettingValues& values)
{
  return [values](const std::string& text) {
    return readValue(values, text) ? "" : "found \"" + text + "\", expected " + expectedOf(values);
  };
}

//------------------------------------------------------------------------------
std::string optionOf(std::string settingName)
{
  std::replace(settingName.begin(), settingName.end(), '_', '-');
  return "--" + settingName;
}

//------------------------------------------------------------------------------
std::string helpOf(const Setting& setting)
{
  const std::string byDefault = defaultOf(setting);
  return setting.meaning + (setting.unit.empty() ? "" : " (" + setting.unit + ")") + ": " +
    setting.expected() + (byDefault.empty() ? "" : "; default " + byDefault);
}

//------------------------------------------------------------------------------
std::string headingOf(const SettingsTable& table)
{
  const std::string techniques = techniquesWith(table);
  return techniques.empty() ? table.title : table.title + " (" + techniques + ")";
}

//------------------------------------------------------------------------------
void addSettingOptions(CLI::App& command, std::map<std::string, std::string>& values,
  const std::vector<std::string>& without)
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
