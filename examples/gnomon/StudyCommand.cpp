#include "Commands.h"
#include "Errors.h"
#include "Files.h"
#include "Machine.h"
#include "Progress.h"
#include "Report.h"
#include "SettingOptions.h"
#include "Study.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>
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
  std::vector<std::string> techniques; ///< empty: the plan's
  StudyPlan plan;
};

/// Techniques for area lights. For point lights they equal other techniques, but are slower.
const std::set<std::string> ofAreaLights = { "montecarlo", "pcss", "penumbra", "sampled" };

/// Limit a study to five minutes on two cores.
void makeQuick(StudyOptions& options)
{
  options.plan.scenes = { "bunny", "posts", "terrain", "soft-stack", "soft-panels" };
  options.plan.views = 1;
  options.plan.lightSamples = { 64 };
  options.plan.hardTechniques = { "nsm", "pcf", "vsm", "lispsm", "pssm", "selective", "silhouette",
    truthTechnique };
  options.plan.softTechniques = { "nsm", "pcf", "vsm", "pcss", "montecarlo", "penumbra",
    truthTechnique };
  options.plan.comparison.mapSizesTexels = { 512, 2048 };
  options.plan.comparison.frames = 5;
  options.plan.comparison.truthSamples = 1024;
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

/// Return a list without duplicates.
template <typename Value>
void dropRepeated(std::vector<Value>& values)
{
  std::set<Value> seen;
  values.erase(std::remove_if(values.begin(), values.end(),
                 [&](const Value& value) { return !seen.insert(value).second; }),
    values.end());
}

void study(StudyOptions options)
{
  dropRepeated(options.plan.scenes);
  dropRepeated(options.plan.lightSamples);
  dropRepeated(options.plan.comparison.mapSizesTexels);
  dropRepeated(options.techniques);
  if (options.quick)
  {
    makeQuick(options);
  }
  const PictureSize size = parseSize(options.size);
  options.plan.comparison.width = size.width;
  options.plan.comparison.height = size.height;
  if (!options.techniques.empty())
  {
    options.plan.hardTechniques = options.plan.softTechniques = options.techniques;
  }
  prepareReportFolder(options.folder, "study.html");
  Progress progress("reading scenes");
  const auto start = std::chrono::steady_clock::now();
  double shareBefore = -1.0; // share of cases that were finished earlier
  const std::vector<StudyRow> rows = runStudy(options.plan, options.folder,
    [&](double share, const std::string& step)
    {
      shareBefore = shareBefore < 0.0 ? share : shareBefore;
      const double ofRest = (share - shareBefore) / (1.0 - shareBefore);
      progress.begin(step + timeLeft(start, ofRest), share);
    });
  progress.begin("writing the page");
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  writeWholeFile(options.folder + "/study.csv", toCsv(rows));
  writeWholeFile(options.folder + "/study.html", studyPage(rows, machineLine(window)));
  progress.print("Study: " + options.folder + "/study.html", std::cout);
}

} // namespace

//------------------------------------------------------------------------------
void addStudyCommand(CLI::App& app)
{
  CLI::App* const command = app.add_subcommand("study",
    "Measure the cost of accuracy: error and time of techniques over scenes, views, map sizes and "
    "samples, as a page and a table; continues an interrupted study");
  const auto options = std::make_shared<StudyOptions>();
  ComparisonPlan& comparison = options->plan.comparison;
  options->plan.scenes = { "bunny", "posts", "plates", "terrain", "atrium", "bench-side", "room",
    "soft-stack", "soft-panels", "soft-plates" };
  options->plan.views = 3;
  options->plan.lightSamples = { 16, 64 };
  options->plan.softTechniques = allTechniques();
  std::copy_if(options->plan.softTechniques.begin(), options->plan.softTechniques.end(),
    std::back_inserter(options->plan.hardTechniques),
    [](const std::string& name) { return ofAreaLights.count(name) == 0; });
  comparison.mapSizesTexels = { 512, 1024, 2048 };
  comparison.frames = 11;
  command->add_option("-o,--output", options->folder, "Folder for the study")->required();
  const auto addList = [&](const char* name, auto& values, const std::string& meaning)
  { return command->add_option(name, values, meaning)->delimiter(',')->capture_default_str(); };
  CLI::Option* const quick =
    command->add_flag("--quick", options->quick, "A small study, of a few minutes");
  addList("--scenes", options->plan.scenes,
    "Scenes: built-in names, scene files or model files, separated by commas")
    ->excludes(quick);
  addList("--techniques", options->techniques,
    "Techniques, as for gnomon compare. By default all, except, for point lights, " +
      gnomon::listOf({ ofAreaLights.begin(), ofAreaLights.end() }))
    ->excludes(quick);
  addList("--map-sizes", comparison.mapSizesTexels, "Sides of the shadow maps in texels")
    ->check(CLI::Range(16, 16384))
    ->excludes(quick);
  addList("--samples", options->plan.lightSamples, "Samples of area lights")
    ->check(CLI::Range(1, 65536))
    ->excludes(quick);
  command
    ->add_option("--views", options->plan.views,
      "Views of each scene: its camera, turned about its target by 25 degrees to one side and to "
      "the "
      "other side, by 50, and so on")
    ->check(CLI::Range(1, 8))
    ->capture_default_str()
    ->excludes(quick);
  command->add_option("--size", options->size, "Window size in pixels, WIDTHxHEIGHT")
    ->capture_default_str()
    ->excludes(quick);
  command->add_option("--frames", comparison.frames, "Timed frames per variant and motion")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str()
    ->excludes(quick);
  command
    ->add_option("--truth-samples", comparison.truthSamples,
      "Samples per area light and pixel of the ray-traced truth")
    ->check(CLI::Range(1, 65536))
    ->capture_default_str()
    ->excludes(quick);
  command->callback([options] { study(*options); });
}

} // namespace gnomon::tool
