#include "SettingOptions.h"

#include "lights/ShadowSettings.h"
#include "shadowtech/Registry.h"

#include <algorithm>

namespace gnomon::tool
{
namespace
{

/// What is wrong with a setting's value; empty if nothing is.
std::string refuse(const Setting& setting, const std::string& text)
{
  return takes(setting, text) ? "" : "found \"" + text + "\", expected " + expectedBy(setting);
}

} // namespace

//------------------------------------------------------------------------------
void addSettingOptions(CLI::App& command, std::map<std::string, std::string>& values,
  const std::vector<std::string>& without)
{
  for (const Setting& setting : shadowSettings())
  {
    if (std::find(without.begin(), without.end(), setting.name) != without.end())
    {
      continue;
    }
    std::string option = "--" + setting.name;
    std::replace(option.begin(), option.end(), '_', '-');
    command.add_option(option, values[setting.name], setting.help + ": " + expectedBy(setting))
      ->check([&setting](const std::string& text) { return refuse(setting, text); })
      ->option_text(" ");
  }
}

} // namespace gnomon::tool
