#include "Commands.h"
#include "ComparisonRun.h"
#include "Errors.h"
#include "view/Viewer.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

namespace gnomon::tool
{
namespace
{

struct ViewOptions
{
  std::string scene;
  std::string settings;
  std::string size;
  std::vector<std::string> techniques;
  int mapSizeTexels = 0; ///< 0: not given
  int truthSamples = 0;  ///< 0: not given
  std::string sun;
  std::string saveTo;
  std::string press;
  bool keys = false;
};

/// Refuse to start without an X server: VTK would abort.
void requireScreen()
{
  vtkNew<vtkRenderWindow> window;
  const char* const display = std::getenv("DISPLAY");
  if (window->IsA("vtkXOpenGLRenderWindow") && (!display || !*display))
  {
    throw BadInput("view: DISPLAY names no X server, expected one; gnomon render takes none");
  }
}

std::pair<ViewState, Scene> beginning(const ViewOptions& options)
{
  if (options.scene.empty() == options.settings.empty())
  {
    throw BadInput("view: expected a scene or --settings, and one of them");
  }
  std::pair<ViewState, Scene> result;
  auto& [state, scene] = result;
  if (options.settings.empty())
  {
    scene = loadScene(options.scene);
    state = initialState(options.scene, scene);
  }
  else
  {
    result = readView(options.settings);
  }
  if (!options.size.empty())
  {
    state.size = parseSize(options.size);
  }
  if (options.mapSizeTexels > 0)
  {
    state.mapSizeTexels = options.mapSizeTexels;
  }
  if (options.truthSamples > 0)
  {
    state.truthSamples = options.truthSamples;
  }
  if (!options.sun.empty())
  {
    placeSun(state, scene, parseSunTime(options.sun, "--sun"));
  }
  return result;
}

/// Return the techniques of [ and ]: those of --techniques, or auto and those of compare.
std::vector<std::string> techniquesOf(const ViewOptions& options, const Scene& scene)
{
  if (!options.techniques.empty())
  {
    for (const std::string& technique : options.techniques)
    {
      parseTechnique(technique);
    }
    return options.techniques;
  }
  std::vector<std::string> techniques = { "auto" };
  for (const std::string& usual : usualTechniques(castsSoftShadows({}, scene)))
  {
    techniques.push_back(usual);
  }
  return techniques;
}

void view(const ViewOptions& options)
{
  if (options.keys)
  {
    std::cout << keysAsMarkdown();
    return;
  }
  requireScreen();
  auto [state, scene] = beginning(options);
  ViewChoices choices{ techniquesOf(options, scene) };
  if (!options.techniques.empty())
  {
    state.technique = choices.techniques.front();
  }
  const std::string saveTo =
    options.saveTo.empty() ? std::filesystem::path(state.scene).stem().string() : options.saveTo;
  Viewer viewer(std::move(scene), state, std::move(choices), saveTo);
  viewer.open();
  viewer.press(options.press);
  if (!viewer.interactor()->GetDone())
  {
    viewer.run();
  }
}

} // namespace

void addViewCommand(CLI::App& app)
{
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* const command =
    app.add_subcommand("view", "Look at a scene's shadows, beside the truth, in a window");
  command->add_option("scene", options->scene,
    "A built-in scene's name, a scene file (.json) or a model file (.obj .ply .stl .vtp .3ds .glb "
    ".gltf)");
  command->add_option("--settings", options->settings,
    "A settings file that the viewer has saved, in place of a scene");
  command->add_option(
    "--size", options->size, "Size of the picture in pixels, WIDTHxHEIGHT; by default 960x720");
  command
    ->add_option("--techniques", options->techniques,
      "The techniques that [ and ] choose among, separated by commas; each may have settings, for "
      "example nsm:fit=frame,pcf:kernel=box. By default auto and those of `gnomon compare`")
    ->delimiter(',');
  command->add_option("--map-size", options->mapSizeTexels, "Side of the shadow maps in texels")
    ->check(CLI::Range(16, 16384));
  command
    ->add_option("--truth-samples", options->truthSamples,
      "Samples of each area light by which the truth is traced; by default 64")
    ->check(CLI::Range(1, 65536));
  command->add_option("--sun", options->sun,
    "Have the sun shine as at a date, time, north latitude and east longitude, for example "
    "2024-06-21T12:00+02:00,48.1,11.6; y is up, and north is -z");
  command->add_option("-o,--output", options->saveTo,
    "Where the key g saves: OUTPUT-1.png and OUTPUT-1.json, and so on; by default the scene's "
    "name");
  command->add_option(
    "--press", options->press, "Keys to press once the window is open, for example \"] gq\"");
  command->add_flag("--keys", options->keys, "Print the keys as a table in Markdown, and no more");
  command->callback([options] { view(*options); });
}

} // namespace gnomon::tool
