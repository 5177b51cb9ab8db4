// How much shadows flicker: the share of the pixels at shadows' edges that turn from right to wrong
// or back from one frame to the next, while the camera or the light moves by small steps. The truth
// flickers by 0; a shadow that moves with its map's texels, by much.
//
// A picture that moves scans what is wrong in it at other points, and would flicker by that alone.
// So for a moving camera the maps are fitted to where it is, and looked up from where it was at
// first.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "VtkMessages.h"

#include "plugin/VisibilityImages.h"
#include "shadowtech/Registry.h"

#include <vtkCamera.h>
#include <vtkMath.h>

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
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

/// What moves, and by how much per step.
enum class Movement
{
  CameraAside, ///< by a tenth of a texel of a map of the whole scene
  CameraTurned,
  LightTurned
};
constexpr std::array<Movement, 3> allMovements = { Movement::CameraAside, Movement::CameraTurned,
  Movement::LightTurned };

void moveAside(FrameVariant& variant, double texels)
{
  double bounds[6];
  variant.renderer()->ComputeVisiblePropBounds(bounds);
  const double diagonal =
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  const double distance = texels * diagonal / variant.spec().mapSizeTexels;
  vtkCamera* const camera = variant.renderer()->GetActiveCamera();
  std::array<double, 3> position;
  std::array<double, 3> target;
  std::array<double, 3> aside;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(target.data());
  vtkMath::Cross(camera->GetDirectionOfProjection(), camera->GetViewUp(), aside.data());
  vtkMath::Normalize(aside.data());
  for (std::size_t k = 0; k < 3; ++k)
  {
    position[k] += distance * aside[k];
    target[k] += distance * aside[k];
  }
  camera->SetPosition(position.data());
  camera->SetFocalPoint(target.data());
}

const std::vector<float>& draw(FrameVariant& variant, Motion motion, int step)
{
  variant.pass()->KeepVisibilityOn();
  variant.drawFrame(motion, step);
  const VisibilityImages& kept = variant.pass()->GetVisibility();
  if (kept.visibility.empty())
  {
    throw Failure(variant.spec().name() + ": no light casts a shadow");
  }
  return kept.visibility.front();
}

/// The first light's visibility, by maps that are fitted to where the camera is at this step, seen
/// from where it was at first.
const std::vector<float>& drawFitted(FrameVariant& variant, Movement movement, int step)
{
  variant.renderer()->SetPass(makePass(variant.spec())); // which is fitted once, here
  if (movement == Movement::CameraTurned)
  {
    draw(variant, Motion::Camera, step);
  }
  else
  {
    moveAside(variant, 0.1 * step);
    draw(variant, Motion::Static, 0);
    moveAside(variant, -0.1 * step);
  }
  return draw(variant, Motion::Static, 0);
}

/// The first light's visibility in every frame of a movement.
std::vector<std::vector<float>> drawAll(
  VariantSpec spec, const Scene& scene, const Options& options, Movement movement)
{
  const bool fits =
    spec.settings.count("fit") || findTechnique(spec.technique)->projection != Projection::Uniform;
  if (fits && movement != Movement::LightTurned)
  {
    spec.settings["fit"] = "once";
  }
  FrameVariant variant(spec, scene, options.sidePixels, options.sidePixels);
  std::vector<std::vector<float>> frames;
  for (int step = 0; step <= options.frames; ++step)
  {
    frames.push_back(movement == Movement::LightTurned ? draw(variant, Motion::Light, step)
        : fits                                         ? drawFitted(variant, movement, step)
                                                       : draw(variant, Motion::Static, 0));
  }
  return frames;
}

/// Pixels whose neighbour to the right or below is lit otherwise.
std::size_t countEdges(const std::vector<float>& truth, int side)
{
  std::size_t edges = 0;
  for (int y = 0; y + 1 < side; ++y)
  {
    for (int x = 0; x + 1 < side; ++x)
    {
      const auto i = static_cast<std::size_t>(y * side + x);
      edges += truth[i] != truth[i + 1] || truth[i] != truth[i + static_cast<std::size_t>(side)];
    }
  }
  return edges;
}

double flicker(const std::vector<std::vector<float>>& frames,
  const std::vector<std::vector<float>>& truth, int side)
{
  const auto isWrong = [&](std::size_t frame, std::size_t pixel)
  { return std::abs(frames[frame][pixel] - truth[frame][pixel]) > 0.5f; };
  std::size_t turned = 0;
  std::size_t edges = 0;
  for (std::size_t frame = 1; frame < frames.size(); ++frame)
  {
    edges += countEdges(truth[frame], side);
    for (std::size_t pixel = 0; pixel < truth[frame].size(); ++pixel)
    {
      turned += isWrong(frame, pixel) != isWrong(frame - 1, pixel);
    }
  }
  return edges == 0 ? 0.0 : static_cast<double>(turned) / static_cast<double>(edges);
}

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
  std::vector<std::vector<std::vector<float>>> truths;
  for (const Movement movement : allMovements)
  {
    truths.push_back(drawAll(parseTechnique("raytraced"), scene, options, movement));
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
    for (std::size_t k = 0; k < allMovements.size(); ++k)
    {
      const auto frames = drawAll(spec, scene, options, allMovements[k]);
      std::cout << " " << 100.0 * flicker(frames, truths[k], options.sidePixels) << " |"
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
