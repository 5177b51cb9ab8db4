#include "BuiltinScenes.h"
#include "Commands.h"
#include "Errors.h"
#include "Files.h"
#include "ImageFile.h"
#include "Progress.h"
#include "Scene.h"
#include "SceneFraming.h"
#include "SettingOptions.h"
#include "Vec3.h"
#include "VtkMessages.h"
#include "view/View.h"

#include "lights/LightManager.h"
#include "plugin/pass/ReportText.h"
#include "plugin/vtkGnomonLightSamplingPass.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <nlohmann/json.hpp>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkOpenGLState.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <utility>

namespace gnomon::tool
{

namespace
{

///@{
/// The names of vtkGnomonShadowPass::RouteType and SkyModelType, in their order.
const std::vector<std::string> routes = { "auto", "inline", "image", "deferred" };
const std::vector<std::string> skyModels = { "uniform", "dome", "overcast" };
///@}

int indexOf(const std::string& name, const std::vector<std::string>& names)
{
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The options of the command line.
struct RenderOptions
{
  std::string scene;
  std::string viewFile; ///< a file of `gnomon view` in place of the other options
  std::string picture;
  std::string size = "1024x1024";
  std::map<std::string, std::string> settings; ///< of all lights, by name; empty values: not given
  std::string route = "auto";
  bool shadeSamples = false;
  std::vector<std::string> lights;
  std::string camera;
  bool parallel = false;
  std::optional<bool> ground;    ///< none: the scene decides
  std::optional<double> ambient; ///< none: the surfaces decide
  bool glass = false;
  bool volumes = false;
  std::optional<double> sky; ///< intensity; none: the scene's
  std::string skyModel = "uniform";
  double skyDistance = 0.0; ///< beyond which nothing hides it; 0: no limit
  std::string visibility;
  std::string stats;
  std::string classes;
};

std::filesystem::path fullPath(const std::string& path)
{
  std::error_code ignored; // on errors, the path stays unchanged
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
}

/// Refuse invalid options before anything is loaded.
void check(const RenderOptions& options)
{
  std::map<std::filesystem::path, const char*> taken = { { fullPath(options.scene), "scene" } };
  struct Output
  {
    const char* option;
    const std::string& file;
    std::vector<std::string> types;
  };
  for (const auto& [option, file, types] :
    { Output{ "--output", options.picture, { ".png", ".exr" } },
      Output{ "--visibility", options.visibility, { ".exr" } },
      Output{ "--stats", options.stats, { ".json" } },
      Output{ "--classes", options.classes, { ".png", ".exr" } } })
  {
    const bool isPicture = &file == &options.picture;
    if (file.empty() && !isPicture)
    {
      continue;
    }
    requireWritableFile(file, option, types);
    if (const auto [other, isFree] = taken.emplace(fullPath(file), option); !isFree)
    {
      throw BadInput(
        std::string(option) + ": " + file + ": is the file of " + other->second + ", too");
    }
    if (options.shadeSamples && !isPicture)
    {
      throw BadInput(std::string(option) +
        ": describes one picture, and --shade-samples averages many, expected one of them");
    }
  }
  if (options.ground && findBuiltinScene(options.scene))
  {
    throw BadInput(std::string(*options.ground ? "--ground" : "--no-ground") + ": found " +
      options.scene + ", a built-in scene, whose ground is its own; expected a model or a scene " +
      "file");
  }
  // The options have already refused unknown names.
  ShadowSettings settings;
  settings.technique = options.settings.at("technique");
  settings.estimator = options.settings.at("estimator");
  const TechniqueInfo& info = estimatorOf(settings).info;
  if (options.route == "inline" && !info.isPointwise())
  {
    throw BadInput("--route inline: technique " + info.name +
      " works on the screen, expected --route image or auto");
  }
}

/// @param aspect the picture's width divided by its height
Scene loadWithOptions(const RenderOptions& options, double aspect)
{
  Scene scene = loadScene(options.scene, options.ground);
  if (options.ambient)
  {
    setAmbient(scene, *options.ambient);
  }
  if (!options.lights.empty())
  {
    scene.lights.clear();
    scene.hasDefaultLight = false;
    for (const std::string& spec : options.lights)
    {
      scene.lights.push_back(parseLight(spec));
    }
  }
  if (!options.camera.empty())
  {
    scene.camera = parseCamera(options.camera, scene.camera);
  }
  if (options.parallel)
  {
    SceneCamera& camera = scene.camera; // shows the target in the same size
    const double halfAngle = 0.5 * vtkMath::RadiansFromDegrees(camera.fovDegrees);
    camera.parallelScale =
      camera.parallelScale.value_or(length(camera.target - camera.position) * std::tan(halfAngle));
  }
  placeDefaultLight(scene, aspect);
  for (SceneLight& light : scene.lights)
  {
    for (const auto& [name, value] : options.settings)
    {
      if (!value.empty())
      {
        light.settings[name] = value;
      }
    }
  }
  return scene;
}

/// Return the largest value of an integer setting over all lights; its default if no light sets it.
int mostOf(const char* name, const Scene& scene)
{
  const Setting& setting = *findSetting(name);
  const auto valueOf = [&](const ShadowSettings& settings)
  { return std::get<int>(setting.read(settings)); };
  std::optional<int> most;
  for (const SceneLight& light : scene.lights)
  {
    const auto said = light.settings.find(name);
    ShadowSettings settings;
    if (said != light.settings.end() && setting.set(settings, said->second))
    {
      most = std::max(most.value_or(valueOf(settings)), valueOf(settings));
    }
  }
  return most.value_or(valueOf({}));
}

/// Refuse lights with contradictory settings.
void requireComposition(vtkRenderer* renderer)
{
  for (ShadowLight light : LightManager().collect(renderer, {}).lights)
  {
    try
    {
      compose(light);
    }
    catch (const CompositionError& error)
    {
      throw BadInput(
        nameOf(light) + " with the technique " + light.technique + ": " + error.what());
    }
  }
}

/// Refuse pictures that exceed the limits of the window's OpenGL.
void requireDrawable(const PictureSize& size, vtkOpenGLRenderWindow* window)
{
  window->Render(); // creates the context
  window->MakeCurrent();
  GLint side = 0;
  GLint viewport[2] = { 0, 0 };
  window->GetState()->vtkglGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  window->GetState()->vtkglGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  requireDrawable(size, side, viewport[0], viewport[1]);
}

/// Add a frame to the report of a picture: sums of times and counts, and the rest from the last
/// frame.
void addFrame(FrameReport& picture, const FrameReport& frame)
{
  const FrameReport before = std::exchange(picture, frame);
  picture.stages = before.stages;
  for (const StageTime& stage : frame.stages)
  {
    const auto same = std::find_if(picture.stages.begin(), picture.stages.end(),
      [&stage](const StageTime& other) { return other.name == stage.name; });
    same == picture.stages.end() ? picture.stages.push_back(stage)
                                 : void(same->milliseconds += stage.milliseconds);
  }
  picture.wallMilliseconds += before.wallMilliseconds;
  for (int FrameReport::*count : { &FrameReport::mapBakes, &FrameReport::programCompiles,
         &FrameReport::bvhBuilds, &FrameReport::bvhRefits, &FrameReport::surfacesExtracted,
         &FrameReport::surfacesRetransformed })
  {
    picture.*count += before.*count;
  }
}

/// Return settings, timings and counts for the visibility file's header.
std::map<std::string, std::string> makeHeader(
  const RenderOptions& options, const FrameReport& report)
{
  std::map<std::string, std::string> header;
  header["scene"] = options.scene;
  header["route"] = report.route;
  header["wall_milliseconds"] = std::to_string(report.wallMilliseconds);
  for (const StageTime& stage : report.stages)
  {
    header["milliseconds." + stage.name] = std::to_string(stage.milliseconds);
  }
  for (const LightReport& light : report.lights)
  {
    const std::string prefix = "light." + std::to_string(light.sceneIndex);
    header[prefix + ".technique"] = light.casts ? light.technique : "none: " + light.reason;
    header[prefix + ".map_size_texels"] = std::to_string(light.mapSizeTexels);
    if (!light.fit.empty())
    {
      header[prefix + ".fit"] = light.fit;
    }
    if (!light.kernel.empty())
    {
      header[prefix + ".kernel"] = light.kernel;
      header[prefix + ".kernel_size_texels"] = std::to_string(light.kernelTexels);
    }
    header[prefix + ".traced_pixels"] = std::to_string(light.tracedPixels);
    header[prefix + ".rays"] = std::to_string(light.rays);
    for (const ClassCount& count : light.classes)
    {
      header[prefix + ".pixels." + count.name] = std::to_string(count.pixels);
    }
  }
  return header;
}

/// Draws what the viewer showed when it saved this file.
void renderSettings(const RenderOptions& options)
{
  requireWritableFile(options.picture, "--output", { ".png", ".exr" });
  Progress progress("reading " + options.viewFile);
  auto [state, scene] = readView(options.viewFile);
  const auto window = makeOffScreenWindow();
  window->SetSize(1, 1);
  requireDrawable(state.size, window);
  progress.begin("rendering");
  writePicture(drawWithoutScreen(state, std::move(scene)), options.picture);
}

void render(const RenderOptions& options)
{
  if (options.scene.empty() == options.viewFile.empty())
  {
    throw BadInput("render: expected a scene or --settings, and one of them");
  }
  if (!options.viewFile.empty())
  {
    renderSettings(options);
    return;
  }
  check(options);
  const PictureSize size = parseSize(options.size);
  Progress progress("reading " + options.scene);
  Scene scene = loadWithOptions(options, size.aspect());
  scene.isGlass = scene.isGlass || options.glass;
  const int samplesPerFrame = mostOf("progressive", scene);
  if (options.shadeSamples)
  {
    for (SceneLight& light : scene.lights)
    {
      light.settings.erase("progressive"); // belongs to the sampling pass
    }
  }
  for (const std::string& note : scene.notes)
  {
    progress.print("gnomon: note: " + note);
  }

  progress.begin("rendering");
  VtkMessages messages;
  const vtkSmartPointer<vtkRenderer> renderer = makeRenderer(scene, size.aspect());
  requireComposition(renderer);
  const auto window = makeOffScreenWindow();
  window->SetSize(1, 1);
  requireDrawable(size, window);
  window->SetSize(size.width, size.height);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetRoute(indexOf(options.route, routes));
  shadows->SetMeasureStages(!options.stats.empty() || !options.visibility.empty());
  const bool givesVisibility = !options.visibility.empty() || !options.classes.empty();
  shadows->SetKeepVisibility(givesVisibility);
  shadows->SetSmoothTerminators(!givesVisibility); // visibility files compare triangles
  shadows->SetTranslucentCasters(scene.isGlass);
  shadows->SetVolumeCasters(options.volumes);
  shadows->SetSkyIntensity(options.sky.value_or(scene.sky));
  shadows->SetSkyDistance(options.skyDistance);
  shadows->SetSkyUp(0.0, 1.0, 0.0);
  shadows->SetSkyModel(indexOf(options.skyModel, skyModels));
  // The only frame should show techniques with their maps.
  shadows->SetSetting("bake", "always");
  shadows->SetTechnique(vtkGnomonShadowPass::GetDefaultTechnique());
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetDelegatePass(shadows);
  sampling->SetSamples(mostOf("light_samples", scene));
  sampling->SetSamplesPerFrame(samplesPerFrame);
  renderer->SetPass(options.shadeSamples ? static_cast<vtkRenderPass*>(sampling) : shadows);
  window->AddRenderer(renderer);
  FrameReport report;
  int frames = 0;
  for (double share = 0.0; share < 1.0; progress.begin("rendering", share))
  {
    window->Render();
    addFrame(report, shadows->GetReport());
    ++frames;
    share = std::min(shadows->GetProgress(), sampling->GetProgress());
  }

  progress.begin("writing " + options.picture);
  for (const std::string& warning : messages.warnings())
  {
    progress.print("gnomon: warning: " + warning);
  }
  if (report.outOfTextureMemory || !report.misfits.empty())
  {
    throw BadInput("rendering: " + messages.errors().front());
  }
  if (!messages.errors().empty())
  {
    throw Failure("rendering: " + messages.errors().front());
  }
  if (!options.classes.empty())
  {
    const Picture classes = classPicture(shadows->GetVisibility());
    if (classes.rgb.empty())
    {
      throw BadInput("--classes: no casting light has a technique with pixel classes, "
                     "expected one that traces, such as silhouette");
    }
    writePicture(classes, options.classes);
  }
  writePicture(capture(window), options.picture);
  if (!options.visibility.empty())
  {
    writeVisibility(shadows->GetVisibility(), options.visibility, makeHeader(options, report));
  }
  if (!options.stats.empty())
  {
    auto json = nlohmann::ordered_json::parse(textOf(report));
    json["frames"] = frames;
    writeWholeFile(options.stats, json.dump(2) + "\n");
  }
}

} // namespace

PictureSize parseSize(const std::string& text)
{
  std::smatch sides;
  const bool isSize = std::regex_match(text, sides, std::regex("([0-9]{1,5})x([0-9]{1,5})"));
  const PictureSize size{ isSize ? std::stoi(sides[1]) : 0, isSize ? std::stoi(sides[2]) : 0 };
  if (std::min(size.width, size.height) < 1 ||
    std::max(size.width, size.height) > largestSidePixels)
  {
    throw BadInput("--size: found \"" + text + "\", expected WIDTHxHEIGHT, each from 1 to " +
      std::to_string(largestSidePixels) + ", for example 1024x768");
  }
  return size;
}

void requireDrawable(const PictureSize& size, int mostTexels, int mostColumns, int mostRows)
{
  const int columns = std::min(mostTexels, mostColumns);
  const int rows = std::min(mostTexels, mostRows);
  if (size.width > columns || size.height > rows)
  {
    throw BadInput("--size: found " + std::to_string(size.width) + "x" +
      std::to_string(size.height) + ", and OpenGL draws no more than " + std::to_string(columns) +
      "x" + std::to_string(rows) + " here (GL_MAX_TEXTURE_SIZE " + std::to_string(mostTexels) +
      ", GL_MAX_VIEWPORT_DIMS " + std::to_string(mostColumns) + " x " + std::to_string(mostRows) +
      ")");
  }
}

void addRenderCommand(CLI::App& app)
{
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene with shadows");
  command->add_option("scene", options->scene,
    "A built-in scene's name, a scene file (.json) or a model file (.obj .ply .stl .vtp .3ds "
    ".glb .gltf)");
  CLI::Option* const output =
    command->add_option("-o,--output", options->picture, "The picture to write, .png or .exr")
      ->required();
  addOption(*command, "--size", options->size, "Size of the picture in pixels, WIDTHxHEIGHT");
  addSettingOptions(*command, options->settings);
  addOption(*command, "--route", options->route,
    "How visibility reaches the picture: inline, image, deferred, auto")
    ->check(CLI::IsMember(routes));
  command->add_flag("--shade-samples", options->shadeSamples,
    "Shade from each point of an area light (--light-samples points, --progressive of them per "
    "frame) with its hard shadows, and show the mean. By default, shade from the centre, times the "
    "visible share of the light");
  command
    ->add_option("--light", options->lights,
      "A light instead of the scene's own; may be repeated, for example "
      "directional:direction=-1,-2,-1;color=1,1,1;intensity=1;technique=nsm;map_size=1024 or "
      "spot:position=3,4,5;target=0,0,0;cone_angle=30 or point:position=3,4,5")
    ->allow_extra_args(false);
  command->add_option("--camera", options->camera,
    "Changes to the scene's camera, for example "
    "position=0,1,5;target=0,0,0;up=0,1,0;fov=45, or parallel_scale=2 for a parallel camera whose "
    "picture is 4 high");
  command->add_flag("--parallel", options->parallel,
    "Use a parallel camera, which shows the target in the same size");
  command->add_flag_function(
    "--ground,!--no-ground",
    [&ground = options->ground](std::int64_t count) { ground = count > 0; },
    "Put models on a ground, or not. By default, model files get a ground, and scene files decide");
  command
    ->add_option("--ambient", options->ambient,
      "The share of its colour, in [0, 1], that each surface shows where no light falls")
    ->check(isOneOf(RealSetting{ 0.0, 1.0 }));
  command->add_flag("--glass", options->glass,
    "Have translucent models let light through, as much as VTK draws of what is behind them; "
    "without it they block all light");
  command->add_flag("--volumes", options->volumes,
    "Have volumes cast, as much as VTK draws of them; without it they cast nothing");
  command
    ->add_option("--sky", options->sky,
      "The intensity of a sky, which lights surfaces as far as they see it; 0.4 brightens what is "
      "in shadow, but for corners")
    ->check(isOneOf(anyLength));
  command
    ->add_option("--sky-distance", options->skyDistance,
      "The length, in world units, beyond which nothing hides the sky, for rooms; 0 is no limit")
    ->check(isOneOf(anyLength));
  addOption(*command, "--sky-model", options->skyModel,
    "The sky: as bright from everywhere, from below, too; none below the horizon; CIE's overcast "
    "one. Up is y")
    ->check(CLI::IsMember(skyModels));
  command->add_option("--visibility", options->visibility,
    "Also write every light's visibility and the receivers, .exr");
  command->add_option("--stats", options->stats,
    "Also write the report of the picture's frames (several with --progressive), .json");
  command->add_option("--classes", options->classes,
    "Also write each pixel's class as a colour, for the first light whose technique has classes: "
    "lit for certain light grey, in shadow for certain dark grey, traced purple, penumbras by "
    "their edges orange, turned away from the light green; .png or .exr");
  CLI::Option* const settings = command->add_option("--settings", options->viewFile,
    "A settings file that `gnomon view` saved, in place of a scene and all other options: its "
    "picture again, byte for byte");
  excludeOthers(*command, settings, output);
  command->callback([options] { render(*options); });
}

} // namespace gnomon::tool
