#include "Commands.h"
#include "ComparisonRun.h"
#include "Progress.h"
#include "Report.h"
#include "SettingOptions.h"

#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <string>

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
  std::string route; ///< empty: the usual route for usual techniques, all routes for others
  bool all = false;  ///< true: compare all techniques
};

ComparisonPlan planOf(const CompareOptions& options, const Scene& scene)
{
  ComparisonPlan plan = options.plan;
  for (const auto& [name, value] : options.plan.settings)
  {
    if (value.empty()) // not given
    {
      plan.settings.erase(name);
    }
  }
  const bool usual = plan.techniques.empty() && !options.all;
  if (plan.techniques.empty())
  {
    plan.techniques = usual ? usualTechniques(castsSoftShadows(plan, scene)) : allTechniques();
  }
  constexpr int routeInline = vtkGnomonShadowPass::ROUTE_INLINE;
  constexpr int routeImage = vtkGnomonShadowPass::ROUTE_IMAGE;
  plan.routes = options.route == "inline" ? std::vector<int>{ routeInline }
    : options.route == "image"            ? std::vector<int>{ routeImage }
    : usual && options.route.empty()      ? std::vector<int>{}
                                          : std::vector<int>{ routeInline, routeImage };
  return plan;
}

void compare(CompareOptions options)
{
  const PictureSize size = parseSize(options.size);
  options.plan.width = size.width;
  options.plan.height = size.height;
  prepareReportFolder(options.folder);
  Progress progress("reading " + options.scene);
  const Scene scene = loadScene(options.scene);
  ComparisonEvents events;
  events.progress = [&](double share, const std::string& step) { progress.begin(step, share); };
  events.firstPanels = [&](const std::vector<Panel>& panels)
  {
    const std::string path = options.folder + "/first.png";
    writePicture(sideBySide(panels), path);
    progress.print("First picture: " + path, std::cout);
  };
  const ComparisonResults results = runComparison(scene, planOf(options, scene), events);
  progress.begin("writing the report");
  writeReport(results, options.folder);
  for (const std::string note : results.json.at("notes"))
  {
    progress.print(note, std::cout);
  }
  progress.print(std::to_string(results.pictures.size()) + " variants of " + scene.name +
      " compared: " + options.folder + "/report.html",
    std::cout);
}

} // namespace

void addCompareCommand(CLI::App& app)
{
  CLI::App* const command = app.add_subcommand("compare",
    "Compare shadow techniques on a scene with ray tracing, plain VTK and vtkShadowMapPass, and "
    "write a report; its folder has first.png within seconds");
  const auto options = std::make_shared<CompareOptions>();
  options->plan.mapSizesTexels = { 1024 };
  command
    ->add_option("SCENE", options->scene, "Scene: a built-in name, a scene file or a model file")
    ->required();
  command->add_option("-o,--output", options->folder, "Folder for the report")->required();
  CLI::Option* const techniques =
    command
      ->add_option("--techniques", options->plan.techniques,
        "Techniques, separated by commas; each may have settings, for example "
        "nsm:fit=frame,pcf:kernel=box:projection=lispsm. By default " +
          listOf(usualTechniques(false)) + "; for lights with an area " +
          listOf(usualTechniques(true)))
      ->delimiter(',');
  command->add_flag("--all", options->all, "Compare all techniques, by all routes")
    ->excludes(techniques);
  addOption(*command, "--map-sizes", options->plan.mapSizesTexels,
    "Sides of the shadow maps in texels, separated by commas")
    ->delimiter(',')
    ->check(CLI::Range(16, 16384));
  addSettingOptions(*command, options->plan.settings, { "technique", "map_size" });
  addOption(*command, "--size", options->size, "Window size in pixels, WIDTHxHEIGHT");
  addOption(*command, "--frames", options->plan.frames,
    "Timed frames per variant and motion; 0: measure errors only")
    ->check(CLI::Range(0, 10000));
  addOption(*command, "--truth-samples", options->plan.truthSamples,
    "Samples per area light and pixel of the ray-traced truth")
    ->check(CLI::Range(1, 65536));
  command
    ->add_option("--route", options->route,
      "Routes of pointwise techniques: inline (in VTK's shaders), image (from a prepass), all. By "
      "default all; default techniques take their usual route: inline, or image for slow ones")
    ->check(CLI::IsMember({ "all", "inline", "image" }));
  command->callback([options] { compare(*options); });
}

} // namespace gnomon::tool
