#include "BuiltinScenes.h"
#include "Commands.h"
#include "Errors.h"
#include "SceneExport.h"

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
  std::cout << std::left << std::setw(20) << name << summary << "\n";
}

/// @throws BadInput when there is no built-in scene of this name
Scene makeBuiltinScene(const std::string& name)
{
  std::string names;
  for (const BuiltinSceneEntry& entry : builtinSceneEntries())
  {
    if (entry.line.name == name)
    {
      return entry.make();
    }
    names += (names.empty() ? "" : ", ") + entry.line.name;
  }
  throw BadInput("--export: found \"" + name + "\", expected one of: " + names);
}

} // namespace

//------------------------------------------------------------------------------
void addTechniquesCommand(CLI::App& app)
{
  app.add_subcommand("techniques", "List the shadow techniques")
    ->callback(
      []
      {
        for (const TechniqueEntry& entry : registry())
        {
          printLine(entry.name, entry.summary);
        }
      });
}

//------------------------------------------------------------------------------
void addScenesCommand(CLI::App& app)
{
  auto exported = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes, or export one");
  command
    ->add_option("--export", *exported,
      "Write a scene as DIR/NAME.json with its models, for other programs to read")
    ->type_name("NAME DIR")
    ->expected(2);
  command->callback(
    [exported]
    {
      if (!exported->empty())
      {
        std::cout << exportScene(makeBuiltinScene(exported->at(0)), exported->at(1)) << "\n";
        return;
      }
      for (const BuiltinScene& scene : builtinScenes())
      {
        printLine(scene.name, scene.summary);
      }
    });
}

} // namespace gnomon::tool
