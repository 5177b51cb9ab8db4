// What a whole frame costs, by wall clock: plain VTK, VTK's own shadows, and the pass in its
// variants take turns frame by frame on one scene.

#include "BenchmarkMain.h"
#include "Commands.h"
#include "Errors.h"
#include "FrameTiming.h"
#include "FrameVariant.h"
#include "Machine.h"
#include "VtkMessages.h"

#include "lights/vtkGnomonLightKeys.h"

#include <vtkCollectionRange.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

struct Options
{
  std::string scene = "bunny";
  std::string size = "1024x1024";
  int mapSizeTexels = 1024;
  int frames = 101;
  std::string jsonFile;
};

/// A variant's name and its median frame under each of allMotions, in milliseconds.
struct Row
{
  std::string name;
  std::array<double, allMotions.size()> milliseconds{};
};

/// The rows that the others are compared with.
constexpr std::size_t plainRow = 0;
constexpr std::size_t shadowMapPassRow = 1;

void castNothing(vtkRenderer* renderer)
{
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    vtkGnomonLightKeys::SetCasts(light, false);
  }
}

class Benchmark
{
public:
  explicit Benchmark(const Options& options)
    : scene_(withoutShadowSettings(loadScene(options.scene)))
    , size_(parseSize(options.size))
  {
    const int map = options.mapSizeTexels;
    const VariantSpec inlined = { "nsm", map, vtkGnomonShadowPass::ROUTE_INLINE, true };
    this->add({ plainTechnique });
    this->add({ shadowMapPassTechnique, map });
    this->add(inlined);
    this->add({ "nsm", map, vtkGnomonShadowPass::ROUTE_IMAGE, true });
    this->add({ "raytraced" });
    this->add(inlined);
    this->rows_.back().name = "pass, no light casts";
    castNothing(this->variants_.back()->renderer());
  }

  void run(int frames)
  {
    std::vector<FrameVariant*> drawn;
    for (const std::unique_ptr<FrameVariant>& variant : this->variants_)
    {
      drawn.push_back(variant.get());
    }
    const VtkMessages messages;
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      const std::vector<double> medians = timeFrames(drawn, allMotions[motion], frames, [] {});
      for (std::size_t i = 0; i < medians.size(); ++i)
      {
        this->rows_[i].milliseconds[motion] = medians[i];
      }
    }
    if (!messages.errors().empty())
    {
      throw Failure("drawing " + this->scene_.name + ": " + messages.errors().front());
    }
  }

  const std::vector<Row>& rows() const { return this->rows_; }
  vtkRenderWindow* window() const { return this->variants_.front()->window(); }

private:
  void add(const VariantSpec& spec)
  {
    this->rows_.push_back({ spec.name() });
    this->variants_.push_back(
      std::make_unique<FrameVariant>(spec, this->scene_, this->size_.width, this->size_.height));
  }

  Scene scene_;
  PictureSize size_;
  std::vector<Row> rows_;
  std::vector<std::unique_ptr<FrameVariant>> variants_;
};

void printTable(const std::vector<Row>& rows)
{
  std::cout << std::fixed << std::left;
  for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
  {
    std::cout << std::setw(24) << motionName(allMotions[motion]) << std::right << std::setw(10)
              << "ms" << std::setw(10) << "x plain" << std::setw(20) << "x vtkShadowMapPass\n"
              << std::left;
    for (const Row& row : rows)
    {
      const double time = row.milliseconds[motion];
      std::cout << "  " << std::setw(22) << row.name << std::right << std::setw(10)
                << std::setprecision(2) << time << std::setprecision(3) << std::setw(10)
                << time / rows[plainRow].milliseconds[motion] << std::setw(19)
                << time / rows[shadowMapPassRow].milliseconds[motion] << "\n"
                << std::left;
    }
  }
  std::cout << std::flush;
}

void writeJson(const Options& options, const Benchmark& benchmark)
{
  nlohmann::ordered_json json = {
    { "scene", options.scene },
    { "size", options.size },
    { "map_size", options.mapSizeTexels },
    { "frames", options.frames },
    { "opengl", openGlName(benchmark.window()) },
    { "processor", processorName() },
  };
  const std::vector<Row>& rows = benchmark.rows();
  for (const Row& row : rows)
  {
    nlohmann::ordered_json variant = { { "name", row.name } };
    for (std::size_t motion = 0; motion < allMotions.size(); ++motion)
    {
      const double time = row.milliseconds[motion];
      variant[motionKey(allMotions[motion])] = {
        { "ms", time },
        { "over_plain", time / rows[plainRow].milliseconds[motion] },
        { "over_vtk_shadow_map_pass", time / rows[shadowMapPassRow].milliseconds[motion] },
      };
    }
    json["variants"].push_back(variant);
  }
  std::ofstream file(options.jsonFile);
  file << json.dump(2) << "\n";
  if (!file.flush())
  {
    throw Failure(options.jsonFile + ": cannot be written");
  }
}

int run(int argc, char** argv)
{
  CLI::App app{ "Times whole frames, the variants taking turns", "gnomon_benchmark_frames" };
  Options options;
  app.add_option("SCENE", options.scene, "Scene, as for gnomon")->capture_default_str();
  app
    .add_option("--size", options.size,
      "Window in pixels, WIDTHxHEIGHT; vtkShadowMapPass is right in square ones only")
    ->capture_default_str();
  app.add_option("--map-size", options.mapSizeTexels, "Side of the shadow maps in texels")
    ->check(CLI::Range(16, 16384))
    ->capture_default_str();
  app.add_option("--frames", options.frames, "Timed frames per variant and motion")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  app.add_option("--json", options.jsonFile, "File for the figures");
  CLI11_PARSE(app, argc, argv);

  Benchmark benchmark(options);
  benchmark.run(options.frames);
  printTable(benchmark.rows());
  if (!options.jsonFile.empty())
  {
    writeJson(options, benchmark);
  }
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_frames", [&] { return gnomon::tool::run(argc, argv); });
}
