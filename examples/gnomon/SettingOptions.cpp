#include "SettingOptions.h"

#include "lights/ShadowSettings.h"
#include "plugin/vtkGnomonShadowPass.h"
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
std::string optionOf(std::string settingName)
{
  std::replace(settingName.begin(), settingName.end(), '_', '-');
  return "--" + settingName;
}

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
    command
      .add_option(
        optionOf(setting.name), values[setting.name], setting.help + ": " + expectedBy(setting))
      ->check([&setting](const std::string& text) { return refuse(setting, text); })
      ->option_text(" ");
  }
}

//------------------------------------------------------------------------------
void addTracerOption(CLI::App& command, int& tracer)
{
  static const std::map<std::string, int> tracers = { { "auto", vtkGnomonShadowPass::TRACER_AUTO },
    { "embree", vtkGnomonShadowPass::TRACER_EMBREE }, { "gpu", vtkGnomonShadowPass::TRACER_GPU } };
  command
    .add_option_function<std::string>(
      "--tracer", [&tracer](const std::string& name) { tracer = tracers.at(name); },
      "Who traces shadow rays: embree (the CPU), gpu (compute shaders), auto (the GPU where OpenGL "
      "draws by hardware)")
    ->check(CLI::IsMember(tracers))
    ->default_str("auto");
}

} // namespace gnomon::tool
