#include "Commands.h"
#include "Files.h"
#include "FrameVariant.h"
#include "Progress.h"
#include "Report.h"
#include "SettingOptions.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/Registry.h"

#include <vtkTransform.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>
#include <set>
#include <string>

namespace gnomon::tool
{
namespace
{

struct StudyOptions
{
  std::string folder;
  std::string size = "1024x1024";
  bool quick = false;
  std::vector<std::string> scenes = { "bunny", "posts", "plates", "terrain", "atrium", "bench-side",
    "room", "soft-stack", "soft-panels", "soft-plates" };
  int views = 3;                       ///< of each scene, by turning its camera
  std::vector<std::string> techniques; ///< empty: those below
  ///@{
  /// For scenes with point lights, and scenes with area lights.
  std::vector<std::string> hardTechniques;
  std::vector<std::string> softTechniques = allTechniques();
  ///@}
  std::vector<int> lightSamples = { 16, 64 }; ///< of area lights, for techniques that sample them
  ComparisonPlan comparison;                  ///< all except the techniques
};

/// Techniques for area lights. For point lights they equal other techniques, but are slower.
const std::set<std::string> ofAreaLights = { "montecarlo", "pcss", "penumbra", "sampled" };

/// Limit a study to five minutes on two cores.
void makeQuick(StudyOptions& options)
{
  options.scenes = { "bunny", "posts", "terrain", "soft-stack", "soft-panels" };
  options.views = 1;
  options.lightSamples = { 64 };
  options.hardTechniques = { "nsm", "pcf", "vsm", "lispsm", "pssm", "selective", "silhouette",
    truthTechnique };
  options.softTechniques = { "nsm", "pcf", "vsm", "pcss", "montecarlo", "penumbra",
    truthTechnique };
  options.comparison.mapSizesTexels = { 512, 2048 };
  options.comparison.frames = 5;
  options.comparison.truthSamples = 1024;
  options.size = "512x512";
}

/// Return a text such as "about 3 min left".
std::string timeLeft(std::chrono::steady_clock::time_point start, double share)
{
  if (share < 0.01)
  {
    return "";
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  const double seconds = passed.count() * (1.0 - share) / share;
  return seconds < 60.0 ? ", less than a minute left"
                        : ", about " + std::to_string(std::lround(seconds / 60.0)) + " min left";
}

template <typename Value>
void dropRepeated(std::vector<Value>& values)
{
  std::set<Value> seen;
  values.erase(std::remove_if(values.begin(), values.end(),
                 [&](const Value& value) { return !seen.insert(value).second; }),
    values.end());
}

struct Case
{
  std::string scene;
  int view = 1;
  ComparisonPlan plan;

  std::string name() const { return this->scene + ", view " + std::to_string(this->view); }

  /// Return the settings that its numbers depend on.
  nlohmann::ordered_json settings() const
  {
    return { { "scene", this->scene }, { "view", this->view }, { "version", GNOMON_VERSION },
      { "techniques", this->plan.techniques }, { "settings", this->plan.settings },
      { "map_sizes", this->plan.mapSizesTexels }, { "width", this->plan.width },
      { "height", this->plan.height }, { "frames", this->plan.frames },
      { "truth_samples", this->plan.truthSamples } };
  }
};

/// Return a technique with each number of samples of area lights, if it samples them.
std::vector<std::string> sampled(const std::string& technique, const std::vector<int>& lightSamples)
{
  const VariantSpec spec = parseTechnique(technique);
  if (spec.settings.count("light_samples") != 0 ||
    !has(estimatorOf(settingsOf(spec)).info, "light_samples"))
  {
    return { technique };
  }
  std::vector<std::string> techniques;
  for (const int samples : lightSamples)
  {
    const bool isDefault = samples == ShadowSettings().lightSamples;
    techniques.push_back(
      technique + (isDefault ? "" : ":light_samples=" + std::to_string(samples)));
  }
  return techniques;
}

std::vector<Case> casesOf(const StudyOptions& options)
{
  std::vector<Case> cases;
  for (const std::string& scene : options.scenes)
  {
    ComparisonPlan plan = options.comparison;
    plan.techniques = options.techniques.empty() ? options.hardTechniques : options.techniques;
    if (castsSoftShadows(plan, loadScene(scene)))
    {
      plan.techniques.clear();
      for (const std::string& technique :
        options.techniques.empty() ? options.softTechniques : options.techniques)
      {
        for (const std::string& each : sampled(technique, options.lightSamples))
        {
          plan.techniques.push_back(each);
        }
      }
    }
    for (int view = 1; view <= options.views; ++view)
    {
      cases.push_back({ scene, view, plan });
    }
  }
  return cases;
}

/// Return a scene's camera, turned about its target: by 25 degrees to one side, to the other side,
/// by 50 degrees, and so on.
SceneCamera turnedTo(const SceneCamera& camera, int view)
{
  constexpr double stepDegrees = 25.0;
  const double degrees = stepDegrees * (view / 2) * (view % 2 == 0 ? 1.0 : -1.0);
  vtkNew<vtkTransform> turn;
  turn->Translate(camera.target.data());
  turn->RotateWXYZ(degrees, camera.up.data());
  turn->Translate(-camera.target[0], -camera.target[1], -camera.target[2]);
  SceneCamera turned = camera;
  turn->TransformPoint(camera.position.data(), turned.position.data());
  return turned;
}

/// Return the rows of a finished case; none if it is missing, damaged or of other settings.
/// @param file of a case, or a damaged one, as after an interruption
Rows finishedRows(const std::string& file, const Case& of)
{
  constexpr std::size_t largestBytes = 1 << 28;
  try
  {
    const Row json = Row::parse(readWholeFile(file, largestBytes));
    return json.at("how") == of.settings() ? json.at("rows").get<Rows>() : Rows();
  }
  catch (const std::exception&)
  {
    return {};
  }
}

Rows runCase(const std::string& file, const Case& of, const ComparisonEvents& events)
{
  Scene scene = loadScene(of.scene);
  scene.name = of.scene;
  scene.camera = turnedTo(scene.camera, of.view);
  Rows rows = rowsOf(runComparison(scene, of.plan, events), of.view);
  for (Row& row : rows)
  {
    // Techniques take their usual route, so names need none.
    const std::string name = row["variant"];
    row["variant"] = std::regex_replace(name, std::regex(" (inline|image)$"), "");
  }
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  writeWholeFile(file, Row{ { "how", of.settings() }, { "rows", rows } }.dump(2) + "\n");
  return rows;
}

void study(StudyOptions options)
{
  dropRepeated(options.scenes);
  dropRepeated(options.lightSamples);
  dropRepeated(options.comparison.mapSizesTexels);
  dropRepeated(options.techniques);
  if (options.quick)
  {
    makeQuick(options);
  }
  const PictureSize size = parseSize(options.size);
  options.comparison.width = size.width;
  options.comparison.height = size.height;
  prepareReportFolder(options.folder, "study.html");
  Progress progress("reading scenes");
  const std::vector<Case> cases = casesOf(options);
  const auto start = std::chrono::steady_clock::now();
  double shareBefore = -1.0; // share of cases that were finished earlier
  double done = 0.0;
  Rows rows;
  for (const Case& of : cases)
  {
    ComparisonEvents events;
    events.progress = [&](double share, const std::string& step)
    {
      const double ofAll = (done + share) / static_cast<double>(cases.size());
      shareBefore = shareBefore < 0.0 ? ofAll : shareBefore;
      const double ofRest = (ofAll - shareBefore) / (1.0 - shareBefore);
      progress.begin(of.name() + ", " + step + timeLeft(start, ofRest), ofAll);
    };
    const std::string file = options.folder + "/" + fileStem(of.name()) + "/rows.json";
    Rows ofCase = finishedRows(file, of);
    ofCase = ofCase.empty() ? runCase(file, of, events) : ofCase;
    rows.insert(rows.end(), ofCase.begin(), ofCase.end());
    ++done;
  }
  progress.begin("writing the page");
  const auto window = makeOffScreenWindow();
  window->Initialize();
  writeWholeFile(options.folder + "/study.csv", csvOf(rows));
  writeWholeFile(options.folder + "/study.html",
    pageOf(rows, processorName() + "; OpenGL: " + openGlName(window)));
  progress.print("Study: " + options.folder + "/study.html", std::cout);
}

} // namespace

void addStudyCommand(CLI::App& app)
{
  CLI::App* const command = app.add_subcommand("study",
    "Measure the cost of accuracy: error and time of techniques over scenes, views, map sizes and "
    "samples, as a page and a table; continues an interrupted study");
  const auto options = std::make_shared<StudyOptions>();
  ComparisonPlan& comparison = options->comparison;
  std::copy_if(options->softTechniques.begin(), options->softTechniques.end(),
    std::back_inserter(options->hardTechniques),
    [](const std::string& name) { return ofAreaLights.count(name) == 0; });
  comparison.mapSizesTexels = { 512, 1024, 2048 };
  comparison.frames = 11;
  CLI::Option* const output =
    command->add_option("-o,--output", options->folder, "Folder for the study")->required();
  const auto addList = [&](const char* name, auto& values, const std::string& meaning)
  { return addOption(*command, name, values, meaning)->delimiter(','); };
  CLI::Option* const quick =
    command->add_flag("--quick", options->quick, "A small study, of a few minutes");
  addList("--scenes", options->scenes,
    "Scenes: built-in names, scene files or model files, separated by commas");
  addList("--techniques", options->techniques,
    "Techniques, as for gnomon compare. By default all, except, for point lights, " +
      gnomon::listOf({ ofAreaLights.begin(), ofAreaLights.end() }));
  addList("--map-sizes", comparison.mapSizesTexels, "Sides of the shadow maps in texels")
    ->check(CLI::Range(16, 16384));
  addList("--samples", options->lightSamples, "Samples of area lights")
    ->check(CLI::Range(1, 65536));
  addOption(*command, "--views", options->views,
    "Views of each scene: its camera, turned about its target by 25 degrees to one side and to "
    "the other side, by 50, and so on")
    ->check(CLI::Range(1, 8));
  addOption(*command, "--size", options->size, "Window size in pixels, WIDTHxHEIGHT");
  addOption(*command, "--frames", comparison.frames, "Timed frames per variant and motion")
    ->check(CLI::Range(1, 10000));
  addOption(*command, "--truth-samples", comparison.truthSamples,
    "Samples per area light and pixel of the ray-traced truth")
    ->check(CLI::Range(1, 65536));
  excludeOthers(*command, quick, output);
  command->callback([options] { study(*options); });
}

} // namespace gnomon::tool
