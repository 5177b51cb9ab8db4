// Prints how much shadows flicker (tests/lab/hard/Flicker.h).

#include "BenchmarkMain.h"
#include "Errors.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "VtkMessages.h"

#include "tests/lab/hard/Flicker.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

struct Options
{
  std::string scene = "terrain";
  std::vector<std::string> techniques = { "nsm", "nsm:fit=frame", "nsm:fit=frame:snap=off",
    "lispsm", "tsm", "pssm", "pcf", "adaptive", "vsm", "evsm", "msm" };
  int sidePixels = 512;
  int mapSizeTexels = 1024;
  int frames = 20;
};

int run(int argc, char** argv)
{
  CLI::App app{ "Moves camera and light by small steps, and prints which share of the pixels at "
                "edges turns wrong or right "
                "per step, in per cent",
    "gnomon_benchmark_flicker" };
  Options options;
  app.add_option("SCENE", options.scene, "Scene: a built-in name or a scene file")
    ->capture_default_str();
  app.add_option("--techniques", options.techniques, "As of gnomon compare")
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--size", options.sidePixels, "Side of the window in pixels")
    ->check(CLI::Range(1, 16384))
    ->capture_default_str();
  app.add_option("--map-size", options.mapSizeTexels, "Side of the maps in texels")
    ->check(CLI::Range(16, 16384))
    ->capture_default_str();
  app.add_option("--frames", options.frames, "Steps of each movement")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const VtkMessages messages;
  const Scene scene = withoutShadowSettings(loadScene(options.scene));
  const auto draw = [&](const VariantSpec& spec, hard::Movement movement)
  {
    return hard::drawMovement(
      spec, scene, options.sidePixels, options.sidePixels, movement, options.frames);
  };
  std::vector<hard::Frames> truths;
  for (const hard::Movement movement : hard::allMovements)
  {
    truths.push_back(draw(parseTechnique("raytraced"), movement));
  }
  std::cout
    << "| | camera moved by 0.1 texel | camera turned by 0.05 degrees | light turned by 0.05 "
       "degrees |\n|---|---|---|---|\n"
    << std::fixed << std::setprecision(2);
  for (const std::string& text : options.techniques)
  {
    VariantSpec spec = parseTechnique(text);
    spec.mapSizeTexels = options.mapSizeTexels;
    std::cout << "| `" << text << "` |";
    for (std::size_t k = 0; k < hard::allMovements.size(); ++k)
    {
      const hard::Frames frames = draw(spec, hard::allMovements[k]);
      std::cout << " " << 100.0 * hard::flicker(frames, truths[k], options.sidePixels) << " |"
                << std::flush;
    }
    std::cout << "\n";
  }
  if (!messages.errors().empty())
  {
    throw Failure("drawing: " + messages.errors().front());
  }
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_flicker", [&] { return gnomon::tool::run(argc, argv); });
}
