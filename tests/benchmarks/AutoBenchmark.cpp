// Measure how well `auto` chooses; print lines of CSV.
// Places: from random places in a scene the camera moves by small steps; the error is that of the
// last frame. At the first places `auto` is compared with single techniques, too; the best one
// within the allowed error is known only afterwards.
// Budget: the camera flies around the scene with a time budget.

#include "BenchmarkMain.h"
#include "Errors.h"
#include "FrameTiming.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::tool
{
namespace
{

struct Options
{
  std::vector<std::string> scenes;
  int places = 20;
  int compared = 20; ///< the first of them, at which `auto` is compared
  unsigned int seed = 1;
  int sidePixels = 512;
  double budget = 0.0; ///< as a multiple of plain VTK's frame; 0: none
};

/// Frames timed at a place, and untimed frames that precede them.
constexpr int timedFrames = 10;
constexpr int framesBefore = 3;
constexpr double stepDegrees = 0.2;

/// The error that the pass allows by default.
constexpr double allowedShare = 0.005;

/// The study's techniques for hard shadows, with which `auto` is compared.
std::vector<VariantSpec> singles()
{
  std::vector<VariantSpec> specs;
  const auto addMaps = [&](const char* technique, const std::vector<int>& sizes)
  {
    for (const int size : sizes)
    {
      VariantSpec spec{ technique, size, vtkGnomonShadowPass::ROUTE_INLINE, true };
      specs.push_back(spec);
    }
  };
  addMaps("nsm", { 512, 1024, 2048, 4096 });
  addMaps("lispsm", { 1024, 2048 });
  addMaps("tsm", { 1024, 2048 });
  addMaps("pssm", { 1024, 2048 });
  specs.push_back({ "silhouette", 1024 });
  specs.push_back({ "raytraced" });
  return specs;
}

/// A way to draw the scene, with its results at the present place.
struct Runner
{
  FrameVariant variant;
  std::vector<double> milliseconds = {};

  Runner(const VariantSpec& spec, const Scene& scene, int side)
    : variant(spec, scene, side, side)
  {
  }
  void place(vtkCamera* camera, double degrees)
  {
    vtkCamera* const own = this->variant.renderer()->GetActiveCamera();
    own->SetPosition(camera->GetPosition());
    own->SetFocalPoint(camera->GetFocalPoint());
    own->SetViewUp(camera->GetViewUp());
    own->Azimuth(degrees);
    own->OrthogonalizeViewUp();
    this->variant.renderer()->ResetCameraClippingRange();
  }
  /// @return milliseconds
  double draw() { return drawTimed(this->variant.window()); }
  VisibilityImages visibility()
  {
    this->variant.pass()->KeepVisibilityOn();
    this->draw();
    VisibilityImages images = this->variant.pass()->GetVisibility();
    this->variant.pass()->KeepVisibilityOff();
    return images;
  }
};

/// Move the camera to a random place around its focal point.
void wander(vtkCamera* camera, std::mt19937& random)
{
  const auto between = [&](double least, double most)
  { return std::uniform_real_distribution<double>(least, most)(random); };
  camera->Azimuth(between(-180.0, 180.0));
  camera->Elevation(between(-25.0, 25.0));
  camera->OrthogonalizeViewUp();
  camera->Dolly(between(0.6, 1.8));
}

/// All ways to draw a scene. The last is `auto`; the one before it is ray tracing, the truth.
class Ways
{
public:
  Ways(const Scene& scene, int sidePixels)
    : scene_(scene)
  {
    for (const VariantSpec& spec : singles())
    {
      this->runners_.push_back(std::make_unique<Runner>(spec, scene, sidePixels));
    }
    this->runners_.push_back(
      std::make_unique<Runner>(VariantSpec{ automaticTechnique, 1024 }, scene, sidePixels));
  }

  Runner& automatic() { return *this->runners_.back(); }

  /// Draw frames while the camera moves by small steps.
  /// @param compares true if all ways draw, in turns; else `auto` alone does
  void move(vtkCamera* camera, bool compares)
  {
    for (const auto& runner : this->runners_)
    {
      runner->milliseconds.clear();
    }
    this->step(camera, 0, compares);
    this->interactive(vtkGnomonShadowPass::INTERACTIVE_ON);
    for (int step = 1; step <= lastStep; ++step)
    {
      this->step(camera, step, compares);
    }
    this->report_ = this->automatic().variant.pass()->GetReport();
    this->interactive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  }

  /// Print the choice of the last frame of move(), and the single techniques at that place.
  void print(int place, vtkCamera* camera, bool compares)
  {
    LightReport chosen;
    for (const LightReport& light : this->report_.lights)
    {
      chosen = light.casts ? light : chosen;
    }
    const VisibilityImages truth = this->visibility(this->runners_.size() - 2, camera);
    double best = 0.0;
    std::string bestName;
    double error = std::nan(""); // unless a single technique equals the choice
    for (std::size_t i = 0; i + 1 < this->runners_.size(); ++i)
    {
      const VariantSpec& spec = this->runners_[i]->variant.spec();
      const bool isChosen = spec.technique == chosen.technique &&
        (spec.technique != "nsm" || spec.mapSizeTexels == chosen.mapSizeTexels);
      if (!compares && !isChosen)
      {
        continue;
      }
      const VisibilityError off =
        measureError(this->visibility(i, camera), truth, this->scene_.lights);
      const double share = off.share(off.wrongPixels());
      const double milliseconds = median(this->runners_[i]->milliseconds);
      if (compares && share <= allowedShare && (bestName.empty() || milliseconds < best))
      {
        best = milliseconds;
        bestName = spec.name();
      }
      error = isChosen ? share : error;
    }
    std::cout << this->scene_.name << "," << place << "," << chosen.technique << ","
              << chosen.mapSizeTexels << "," << error;
    if (compares)
    {
      const double own = median(this->automatic().milliseconds);
      std::cout << "," << own << "," << best << "," << own / best << "," << bestName << ",\""
                << this->report_.choice << "\"" << std::endl;
    }
    else
    {
      std::cout << ",,,,," << std::endl;
    }
  }

private:
  static constexpr int lastStep = framesBefore + timedFrames;

  void interactive(int wish) { this->automatic().variant.pass()->SetInteractive(wish); }

  /// Draw a frame of each way, or of `auto` alone.
  void step(vtkCamera* camera, int step, bool compares)
  {
    for (std::size_t i = compares ? 0 : this->runners_.size() - 1; i < this->runners_.size(); ++i)
    {
      Runner& runner = *this->runners_[i];
      runner.place(camera, step * stepDegrees);
      const double milliseconds = runner.draw();
      if (step > framesBefore)
      {
        runner.milliseconds.push_back(milliseconds);
      }
    }
  }

  /// Return the visibility of the last frame of move().
  VisibilityImages visibility(std::size_t way, vtkCamera* camera)
  {
    Runner& runner = *this->runners_[way];
    runner.place(camera, lastStep * stepDegrees);
    return runner.visibility();
  }

  const Scene& scene_;
  std::vector<std::unique_ptr<Runner>> runners_;
  FrameReport report_; ///< of auto's last frame that moved
};

void compareWithSingles(const Scene& scene, const Options& options)
{
  std::mt19937 random(options.seed);
  Ways ways(scene, options.sidePixels);
  vtkNew<vtkCamera> start;
  start->DeepCopy(ways.automatic().variant.renderer()->GetActiveCamera());
  for (int place = 0; place < options.places; ++place)
  {
    vtkNew<vtkCamera> camera;
    camera->DeepCopy(start);
    wander(camera, random);
    const bool compares = place < options.compared;
    ways.move(camera, compares);
    ways.print(place, camera, compares);
  }
}

/// Keeps all processors busy during its lifetime.
class Load
{
public:
  Load()
  {
    for (unsigned int i = 0; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
    {
      this->threads_.emplace_back(
        [this]
        {
          while (!this->isOver_)
          {
          }
        });
    }
  }
  ~Load()
  {
    this->isOver_ = true;
    for (std::thread& thread : this->threads_)
    {
      thread.join();
    }
  }

private:
  std::atomic<bool> isOver_{ false };
  std::vector<std::thread> threads_;
};

/// Fly once around a scene with a time budget, a multiple of plain VTK's frame. In the middle third
/// the machine has other work, too; plain VTK's frames measure the slowdown.
void fly(const Scene& scene, const Options& options)
{
  constexpr int frames = 180;
  constexpr int third = frames / 3;
  Runner plain({ plainTechnique }, scene, options.sidePixels);
  Runner automatic({ automaticTechnique, 1024 }, scene, options.sidePixels);
  automatic.variant.pass()->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
  vtkNew<vtkCamera> camera;
  camera->DeepCopy(plain.variant.renderer()->GetActiveCamera());
  std::vector<double> plainTimes;
  for (int frame = 0; frame < framesBefore + timedFrames; ++frame)
  {
    plain.place(camera, frame * stepDegrees);
    plainTimes.push_back(plain.draw());
  }
  const double budget = options.budget * median(plainTimes);
  automatic.variant.pass()->SetTimeBudget(budget);
  std::unique_ptr<Load> load;
  int late = 0;
  int lateUnderLoad = 0;
  int changes = 0;
  std::map<std::string, int> taken;
  std::string before;
  for (int frame = 0; frame < frames; ++frame)
  {
    if (frame % third == 0)
    {
      load = frame == third ? std::make_unique<Load>() : nullptr;
    }
    automatic.place(camera, 360.0 * frame / frames);
    const double milliseconds = automatic.draw();
    const std::string technique = automatic.variant.pass()->GetReport().lights[0].technique;
    if (frame < framesBefore) // compile and build
    {
      continue;
    }
    (load ? lateUnderLoad : late) += milliseconds > 1.2 * budget ? 1 : 0;
    changes += !before.empty() && before != technique ? 1 : 0;
    before = technique;
    ++taken[technique];
  }
  std::cout << scene.name << "," << budget << "," << frames - third - framesBefore << "," << late
            << "," << third << "," << lateUnderLoad << "," << changes << "," << taken["nsm"] << ","
            << taken["silhouette"] << std::endl;
}

int run(int argc, char** argv)
{
  CLI::App app{ "Measures how well auto chooses while the camera moves: a line per place",
    "gnomon_benchmark_auto" };
  Options options;
  app.add_option("SCENES", options.scenes, "Scenes: built-in names or scene files")->required();
  app.add_option("--places", options.places, "Places of the camera in each scene")
    ->check(CLI::Range(1, 100000))
    ->capture_default_str();
  app
    .add_option("--compared", options.compared,
      "At how many of them all techniques are timed; elsewhere auto's error alone is measured")
    ->check(CLI::Range(0, 100000))
    ->capture_default_str();
  app.add_option("--seed", options.seed, "Of the places")->capture_default_str();
  app.add_option("--size", options.sidePixels, "Side of the window in pixels")
    ->check(CLI::Range(1, 16384))
    ->capture_default_str();
  app
    .add_option("--budget", options.budget,
      "Fly around each scene instead, with this multiple of plain VTK's time as a budget")
    ->check(CLI::Range(0.0, 1e6))
    ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const VtkMessages messages;
  std::cout << (options.budget > 0.0
      ? "scene,budget ms,frames,late,frames under load,late,changes,by maps,by rays\n"
      : "scene,place,technique,map texels,wrong share,ms,best ms,over best,best,why\n");
  for (const std::string& name : options.scenes)
  {
    const Scene scene = withoutShadowSettings(loadScene(name));
    options.budget > 0.0 ? fly(scene, options) : compareWithSingles(scene, options);
  }
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_benchmark_auto", [&] { return gnomon::tool::run(argc, argv); });
}
