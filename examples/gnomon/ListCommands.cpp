#include "BuiltinScenes.h"
#include "Commands.h"
#include "Errors.h"
#include "Progress.h"
#include "SceneFile.h"
#include "SettingOptions.h"

#include "shadowtech/Registry.h"

#include <iomanip>
#include <iostream>
#include <memory>

namespace gnomon::tool
{

namespace
{

void printLine(const std::string& name, const std::string& summary)
{
  std::cout << std::left << std::setw(28) << name << summary << "\n";
}

/// Return what a setting takes, with its unit: "integer in [16, 16384] (texels)".
std::string valuesOf(const Setting& setting)
{
  std::string values = setting.expected();
  for (const std::string start : { "one of: ", "an ", "a " })
  {
    values.erase(0, values.rfind(start, 0) == 0 ? start.size() : 0);
  }
  return values + (setting.unit.empty() ? "" : " (" + setting.unit + ")");
}

void printSettings()
{
  for (const SettingsTable* table : settingsTables())
  {
    std::cout << headingOf(*table) << "\n";
    for (const Setting& setting : table->settings)
    {
      std::cout << "  ";
      printLine(setting.name, helpOf(setting));
    }
  }
}

void printSettingsPage()
{
  std::cout
    << "# Settings\n\n"
       "A light sets them by `vtkGnomonLightKeys::SetSetting`, the pass by `SetSetting` for "
       "lights that do\nnot, a scene file as members of a light, the program `gnomon` as "
       "options (`kernel_size` is\n`--kernel-size`). `vtkGnomonShadowSettings` has them with "
       "types (`SetKernelSize()`), for passes and\nlights. A light's setting that its technique "
       "lacks is an error that names the techniques with it. A\npass's setting is an error if no "
       "light's technique has it. Shadows stay in both cases.\n`gnomon settings --markdown` makes "
       "this page.\n";
  for (const SettingsTable* table : settingsTables())
  {
    std::cout << "\n## " << headingOf(*table)
              << "\n\n| setting | meaning | values | default |\n|---|---|---|---|\n";
    for (const Setting& setting : table->settings)
    {
      std::cout << "| `" << setting.name << "` | " << setting.meaning << " | " << valuesOf(setting)
                << " | " << defaultOf(setting) << " |\n";
    }
  }
}

} // namespace

void addTechniquesCommand(CLI::App& app)
{
  app.add_subcommand("techniques", "List the shadow techniques")
    ->callback(
      []
      {
        printLine(automaticTechnique, automaticSummary);
        for (const TechniqueEntry& entry : registry())
        {
          printLine(entry.name, entry.summary);
        }
      });
}

void addSettingsCommand(CLI::App& app)
{
  auto asPage = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("settings", "List the settings of lights' shadows");
  command->add_flag("--markdown", *asPage, "As a page for the documentation");
  command->callback([asPage] { *asPage ? printSettingsPage() : printSettings(); });
}

void addScenesCommand(CLI::App& app)
{
  auto exported = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes, or export one");
  command
    ->add_option("--export", *exported,
      "Write a scene as DIR/NAME.json with its models, for other programs to read")
    ->type_name("NAME DIR")
    ->expected(2);
  auto hard = std::make_shared<bool>(false);
  command->add_flag(
    "--hard", *hard, "List the scenes of numerical hard cases, which all commands take as well");
  command->callback(
    [exported, hard]
    {
      if (*hard)
      {
        for (const BuiltinScene& scene : hardScenes())
        {
          printLine(scene.name, scene.summary + " (" + listOf(scene.cases) + ")");
        }
        return;
      }
      if (!exported->empty())
      {
        if (!findBuiltinScene(exported->at(0)))
        {
          throw BadInput(
            "--export: found \"" + exported->at(0) + "\", expected one of: " + builtinSceneNames());
        }
        Progress progress("exporting " + exported->at(0));
        progress.print(exportScene(loadScene(exported->at(0)), exported->at(1)), std::cout);
        return;
      }
      for (const BuiltinScene& scene : builtinScenes())
      {
        printLine(scene.name, scene.summary);
      }
    });
}

} // namespace gnomon::tool
