#include "Commands.h"
#include "Scene.h"

#include "shadowtech/Registry.h"

#include <iomanip>
#include <iostream>

namespace gnomon::tool
{

namespace
{

void printLine(const std::string& name, const std::string& summary)
{
  std::cout << std::left << std::setw(14) << name << summary << "\n";
}

} // namespace

//------------------------------------------------------------------------------
void addTechniquesCommand(CLI::App& app)
{
  app.add_subcommand("techniques", "List the shadow techniques")
    ->callback(
      []
      {
        for (const RegistryEntry& entry : registry())
        {
          printLine(entry.info.name, entry.info.summary);
        }
      });
}

//------------------------------------------------------------------------------
void addScenesCommand(CLI::App& app)
{
  app.add_subcommand("scenes", "List the built-in scenes")
    ->callback(
      []
      {
        for (const BuiltinScene& scene : builtinScenes())
        {
          printLine(scene.name, scene.summary);
        }
      });
}

} // namespace gnomon::tool
