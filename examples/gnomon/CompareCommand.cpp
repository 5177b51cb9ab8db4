#include "Commands.h"
#include "ComparisonRun.h"
#include "Errors.h"
#include "Report.h"
#include "SettingOptions.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <string>

#include <unistd.h>

namespace gnomon::tool
{
namespace
{

struct CompareOptions
{
  std::string scene;
  std::string folder;
  ComparisonPlan plan;
  std::string size = "1024x1024";
  std::string route = "all";
  bool progress = false;
};

/// A line on stderr that fills up.
class ProgressBar
{
public:
  ~ProgressBar()
  {
    if (this->shown_ >= 0)
    {
      std::cerr << '\n';
    }
  }
  void operator()(double share)
  {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == this->shown_)
    {
      return;
    }
    this->shown_ = percent;
    const auto filled = static_cast<std::size_t>(percent / 2);
    std::cerr << "\rcomparing [" << std::string(filled, '#') << std::string(50 - filled, '.')
              << "] " << percent << " %" << std::flush;
  }

private:
  int shown_ = -1;
};

ComparisonResults measure(const CompareOptions& options, const ComparisonPlan& plan)
{
  const Scene scene = loadScene(options.scene);
  ProgressFunction progress;
  ProgressBar bar;
  if (options.progress || isatty(STDERR_FILENO))
  {
    progress = [&bar](double share) { bar(share); };
  }
  const VtkMessages messages;
  ComparisonResults results = runComparison(scene, plan, progress);
  if (!messages.errors().empty())
  {
    throw Failure("drawing " + scene.name + ": " + messages.errors().front());
  }
  return results;
}

void compare(const CompareOptions& options)
{
  ComparisonPlan plan = options.plan;
  plan.inlineRoute = options.route != "image";
  plan.imageRoute = options.route != "inline";
  const PictureSize size = parseSize(options.size);
  plan.width = size.width;
  plan.height = size.height;
  prepareReportFolder(options.folder);
  const ComparisonResults results = measure(options, plan);
  writeReport(results, options.folder);
  for (const std::string& note : results.notes)
  {
    std::cout << note << "\n";
  }
  std::cout << results.variants.size() << " variants of " << results.scene
            << " compared: " << options.folder << "/report.html" << std::endl;
}

std::vector<std::string> allTechniques()
{
  std::vector<std::string> names;
  for (const TechniqueEntry& entry : registry())
  {
    names.push_back(entry.name);
  }
  return names;
}

} // namespace

//------------------------------------------------------------------------------
void addCompareCommand(CLI::App& app)
{
  CLI::App* const command = app.add_subcommand("compare",
    "Compare shadow techniques on a scene with ray tracing, plain VTK and vtkShadowMapPass, and "
    "write "
    "a report");
  const auto options = std::make_shared<CompareOptions>();
  options->plan.techniques = allTechniques();
  options->plan.mapSizesTexels = { 1024 };
  command
    ->add_option("SCENE", options->scene, "Scene: a built-in name, a scene file or a model file")
    ->required();
  command->add_option("-o,--output", options->folder, "Folder for the report")->required();
  command
    ->add_option("--techniques", options->plan.techniques,
      "Techniques, separated by commas; each may have settings, for example "
      "nsm:fit=frame,pcf:kernel=box:projection=lispsm")
    ->delimiter(',')
    ->capture_default_str();
  command
    ->add_option("--map-sizes", options->plan.mapSizesTexels,
      "Sides of the shadow maps in texels, separated by commas")
    ->delimiter(',')
    ->check(CLI::Range(16, 16384))
    ->capture_default_str();
  addSettingOptions(*command, options->plan.settings, { "technique", "map_size" });
  command->add_option("--size", options->size, "Window size in pixels, WIDTHxHEIGHT")
    ->capture_default_str();
  command
    ->add_option("--frames", options->plan.frames,
      "Timed frames per variant and motion; 0: none, errors alone")
    ->check(CLI::Range(0, 10000))
    ->capture_default_str();
  command
    ->add_option("--truth-samples", options->plan.truthSamples,
      "Samples of each area light by which the truth that errors are told by is traced")
    ->check(CLI::Range(1, 65536))
    ->capture_default_str();
  command
    ->add_option("--route", options->route,
      "The routes of techniques that have both: inline (in VTK's shaders), image (from a prepass), "
      "all")
    ->check(CLI::IsMember({ "all", "inline", "image" }))
    ->capture_default_str();
  addTracerOption(*command, options->plan.tracer);
  addRasterizerOption(*command, options->plan.rasterizer);
  command->add_flag("--progress", options->progress,
    "Show a progress bar even when the error output is not a terminal");
  command->callback([options] { compare(*options); });
}

} // namespace gnomon::tool
