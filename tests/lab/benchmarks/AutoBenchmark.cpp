// Measure how well `auto` chooses; print lines of CSV.
// Places: from random places in a scene the camera moves by small steps; the error is that of the
// last frame: the share of wrong pixels, or the root mean square error if a light has an area. At
// the first places `auto` is compared with single techniques, too; the best one within the allowed
// error is known only afterwards.
// Budget: the camera flies around the scene with a time budget.

#include "BenchmarkMain.h"
#include "Errors.h"
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
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <utility>
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
  double error = 0.005;    ///< share of wrong pixels that is allowed
  double softError = 0.03; ///< root mean square error that is allowed under area lights
  double budget = 0.0;     ///< as a multiple of plain VTK's frame; 0: none
};

/// Frames timed at a place, and untimed frames that precede them.
constexpr int timedFrames = 10;
constexpr int framesBefore = 3;
constexpr double stepDegrees = 0.2;

/// Single techniques are timed if their first frame at a place takes at most this factor longer
/// than the fastest. After some timed frames, only the fastest of them go on.
constexpr double slowerAtFirst = 2.0;
constexpr std::size_t framesOfAll = 3;
constexpr std::size_t fastest = 2;

/// A technique that looks maps up in the props' shaders.
VariantSpec inlineMap(const char* technique, int mapSizeTexels)
{
  return { technique, mapSizeTexels, vtkGnomonShadowPass::ROUTE_INLINE, true };
}

VariantSpec ofSamples(const char* technique, int lightSamples)
{
  VariantSpec spec{ technique };
  spec.settings["light_samples"] = std::to_string(lightSamples);
  return spec;
}

/// The study's techniques for hard shadows, with which `auto` is compared.
std::vector<VariantSpec> hardSingles()
{
  std::vector<VariantSpec> specs;
  for (const int size : { 512, 1024, 2048, 4096 })
  {
    specs.push_back(inlineMap("nsm", size));
  }
  for (const char* technique : { "lispsm", "tsm", "pssm" })
  {
    specs.push_back(inlineMap(technique, 1024));
    specs.push_back(inlineMap(technique, 2048));
  }
  specs.push_back({ "silhouette", 1024 });
  specs.push_back({ "raytraced" });
  return specs;
}

/// The study's techniques for soft shadows, and those for hard ones that may err little enough.
std::vector<VariantSpec> softSingles()
{
  std::vector<VariantSpec> specs = { inlineMap("nsm", 1024), { "silhouette", 1024 },
    { "pcss", 1024 }, { "montecarlo", 1024 } };
  for (const int samples : { 1, 4, 6, 8, 10, 12, 16, 32, 64 })
  {
    specs.push_back(ofSamples("penumbra", samples));
    specs.push_back(ofSamples("raytraced", samples));
  }
  return specs;
}

bool hasAreaLights(const Scene& scene)
{
  return std::any_of(scene.lights.begin(), scene.lights.end(),
    [](const SceneLight& light) { return light.area.has_value(); });
}

/// The samples of area lights in the truth.
constexpr int trueSamples = 1024;

/// Single techniques are left out where the maps of a scene's lights would take more.
constexpr double mostMapBytes = 2.0 * 1024 * 1024 * 1024;

/// Return what maps of 4 bytes a texel take, six for each light that shines all around.
double mapBytes(const VariantSpec& spec, const Scene& scene)
{
  const auto maps = std::accumulate(scene.lights.begin(), scene.lights.end(), 0.0,
    [](double sum, const SceneLight& light)
    { return sum + (light.type == SceneLight::Type::Point ? 6.0 : 1.0); });
  return maps * spec.mapSizeTexels * spec.mapSizeTexels * 4.0;
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

/// All ways to draw a scene. The last is `auto`.
class Ways
{
public:
  Ways(const Scene& scene, const Options& options)
    : scene_(scene)
    , isSoft_(hasAreaLights(scene))
    , allowed_(isSoft_ ? options.softError : options.error)
    , exact_(isSoft_ ? ofSamples("raytraced", trueSamples) : VariantSpec{ "raytraced" }, scene,
        options.sidePixels)
  {
    const int sidePixels = options.sidePixels;
    for (const VariantSpec& spec : this->isSoft_ ? softSingles() : hardSingles())
    {
      if (mapBytes(spec, scene) <= mostMapBytes)
      {
        this->runners_.push_back(std::make_unique<Runner>(spec, scene, sidePixels));
      }
    }
    this->runners_.push_back(
      std::make_unique<Runner>(VariantSpec{ automaticTechnique, 1024 }, scene, sidePixels));
    this->automatic().variant.pass()->SetMaximumError(options.error);
    this->automatic().variant.pass()->SetMaximumSoftError(options.softError);
    for (const auto& runner : this->runners_) // compile and bake what is the same at all places
    {
      runner->draw();
      runner->visibility();
    }
  }

  Runner& automatic() { return *this->runners_.back(); }

  /// Draw frames by `auto` while the camera moves by small steps, then print its choice in the last
  /// frame and that frame's error.
  void check(int place, vtkCamera* camera)
  {
    this->move(camera);
    const LightReport chosen = this->chosen();
    this->truth_ = visibility(this->exact_, camera);
    this->printChoice(place, chosen, this->error(chosen, camera));
    std::cout << ",,,,," << std::endl;
  }

  /// Do the same in turns with the single techniques that keep the error in the last frame, and
  /// print the fastest of these, too.
  void compare(int place, vtkCamera* camera)
  {
    this->findRivals(camera);
    this->move(camera);
    const LightReport chosen = this->chosen();
    this->printChoice(place, chosen, this->error(chosen, camera));
    const Runner* const best =
      *std::min_element(this->rivals_.begin(), this->rivals_.end(), isFaster);
    this->rivals_.clear();
    const double own = median(this->automatic().milliseconds);
    const double least = median(best->milliseconds);
    std::cout << "," << own << "," << least << "," << own / least << ","
              << best->variant.spec().name() << ","
              << (chosen.technique == "nsm" ? "" : "\"" + this->report_.choice + "\"") << std::endl;
  }

private:
  static constexpr int lastStep = framesBefore + timedFrames;

  void interactive(int wish) { this->automatic().variant.pass()->SetInteractive(wish); }

  static bool isFaster(const Runner* a, const Runner* b)
  {
    return median(a->milliseconds) < median(b->milliseconds);
  }

  /// Find the single techniques that keep the error in the last frame of a motion and may be the
  /// fastest. Each draws a frame here.
  void findRivals(vtkCamera* camera)
  {
    this->truth_ = visibility(this->exact_, camera);
    std::vector<std::pair<double, Runner*>> drawn;
    for (std::size_t i = 0; i + 1 < this->runners_.size(); ++i)
    {
      Runner& runner = *this->runners_[i];
      runner.milliseconds.clear();
      runner.place(camera, 0.0);
      drawn.emplace_back(runner.draw(), &runner);
    }
    std::sort(drawn.begin(), drawn.end());
    this->rivals_.clear();
    double most = std::numeric_limits<double>::infinity();
    for (const auto& [milliseconds, runner] : drawn)
    {
      if (milliseconds <= most && this->error(*runner, camera) <= this->allowed_)
      {
        most = std::min(most, slowerAtFirst * milliseconds);
        this->rivals_.push_back(runner);
      }
    }
  }

  /// Draw frames by the rivals and by `auto`.
  void move(vtkCamera* camera)
  {
    this->automatic().milliseconds.clear();
    for (int step = 0; step <= lastStep; ++step)
    {
      if (step >= framesBefore)
      {
        for (Runner* const rival : this->rivals_)
        {
          this->draw(*rival, camera, step);
        }
      }
      this->draw(this->automatic(), camera, step);
      this->interactive(vtkGnomonShadowPass::INTERACTIVE_ON);
      this->dropSlowRivals();
    }
    this->report_ = this->automatic().variant.pass()->GetReport();
    this->interactive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  }

  void draw(Runner& runner, vtkCamera* camera, int step)
  {
    runner.place(camera, step * stepDegrees);
    const double milliseconds = runner.draw();
    if (step > framesBefore)
    {
      runner.milliseconds.push_back(milliseconds);
    }
  }

  void dropSlowRivals()
  {
    if (this->rivals_.size() > fastest && this->rivals_.front()->milliseconds.size() == framesOfAll)
    {
      std::sort(this->rivals_.begin(), this->rivals_.end(), isFaster);
      this->rivals_.resize(fastest);
    }
  }

  /// Return what the last casting light had in the last frame that moved.
  LightReport chosen() const
  {
    LightReport chosen;
    for (const LightReport& light : this->report_.lights)
    {
      chosen = light.casts ? light : chosen;
    }
    return chosen;
  }

  /// Return the single technique that shows the same, or null if there is none.
  Runner* single(const LightReport& chosen) const
  {
    for (std::size_t i = 0; i + 1 < this->runners_.size(); ++i)
    {
      const VariantSpec& spec = this->runners_[i]->variant.spec();
      const auto samples = spec.settings.find("light_samples");
      if (spec.technique == chosen.technique &&
        (spec.technique != "nsm" || spec.mapSizeTexels == chosen.mapSizeTexels) &&
        (samples == spec.settings.end() || samples->second == std::to_string(chosen.lightSamples)))
      {
        return this->runners_[i].get();
      }
    }
    return nullptr;
  }

  void printChoice(int place, const LightReport& chosen, double error) const
  {
    std::cout << this->scene_.name << "," << place << "," << chosen.technique << ","
              << chosen.mapSizeTexels << "," << chosen.lightSamples << "," << this->allowed_ << ","
              << error;
  }

  /// Return the visibility of the last frame of a motion.
  static VisibilityImages visibility(Runner& runner, vtkCamera* camera)
  {
    runner.place(camera, lastStep * stepDegrees);
    return runner.visibility();
  }

  /// Return the error of a choice, or NaN if no single technique equals it.
  double error(const LightReport& chosen, vtkCamera* camera) const
  {
    Runner* const single = this->single(chosen);
    return single ? this->error(*single, camera) : std::nan("");
  }

  /// Return the error in the last frame of a motion.
  double error(Runner& runner, vtkCamera* camera) const
  {
    const VisibilityError off =
      measureError(visibility(runner, camera), this->truth_, this->scene_.lights);
    return this->isSoft_ ? off.rootMeanSquare : off.share(off.wrongPixels());
  }

  const Scene& scene_;
  const bool isSoft_;
  const double allowed_;
  Runner exact_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::vector<Runner*> rivals_; ///< drawn in turns with `auto`
  VisibilityImages truth_;      ///< of the last frame at this place
  FrameReport report_;          ///< of auto's last frame that moved
};

void compareWithSingles(const Scene& scene, const Options& options)
{
  std::mt19937 random(options.seed);
  Ways ways(scene, options);
  vtkNew<vtkCamera> start;
  start->DeepCopy(ways.automatic().variant.renderer()->GetActiveCamera());
  for (int place = 0; place < options.places; ++place)
  {
    vtkNew<vtkCamera> camera;
    camera->DeepCopy(start);
    wander(camera, random);
    place < options.compared ? ways.compare(place, camera) : ways.check(place, camera);
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

/// A flight once around a scene with a time budget, a multiple of plain VTK's frame. In the middle
/// third the machine has other work, too. A frame is possible if rays, or the coarsest map that
/// keeps the error, keep the budget in turns with `auto`.
class Flight
{
public:
  Flight(const Scene& scene, const Options& options)
    : scene_(scene)
    , options_(options)
    , plain_({ plainTechnique }, scene, options.sidePixels)
    , rays_({ "raytraced" }, scene, options.sidePixels)
    , automatic_({ automaticTechnique, 1024 }, scene, options.sidePixels)
  {
    for (const int size : { 1024, 2048, 4096 })
    {
      this->maps_.push_back(std::make_unique<Runner>(
        VariantSpec{ "nsm", size, vtkGnomonShadowPass::ROUTE_INLINE, true }, scene,
        options.sidePixels));
    }
    this->camera_->DeepCopy(this->plain_.variant.renderer()->GetActiveCamera());
    this->survey();
    this->budget_ = this->options_.budget * median(this->plain_.milliseconds);
  }

  /// Fly, then print a line.
  void fly()
  {
    this->automatic_.variant.pass()->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    this->automatic_.variant.pass()->SetMaximumError(this->options_.error);
    this->automatic_.variant.pass()->SetTimeBudget(this->budget_);
    std::unique_ptr<Load> load;
    for (int frame = 0; frame < frames; ++frame)
    {
      if (frame % third == 0)
      {
        load = frame == third ? std::make_unique<Load>() : nullptr;
      }
      const double milliseconds = this->draw(this->automatic_, frame);
      const double best = this->best(frame);
      if (frame >= framesBefore) // those before compile and build
      {
        this->count(load ? this->busy_ : this->idle_, milliseconds, best);
      }
    }
    std::cout << this->scene_.name << "," << this->options_.error << "," << this->options_.budget
              << "," << this->budget_;
    for (const Count& count : { this->idle_, this->busy_ })
    {
      std::cout << "," << count.frames << "," << count.possible << "," << count.late;
    }
    std::cout << "," << this->changes_ << "," << this->taken_["nsm"] << ","
              << this->taken_["silhouette"] << std::endl;
  }

private:
  static constexpr int frames = 180;
  static constexpr int third = frames / 3;
  static constexpr int surveyed = 3;             ///< frames from one that is surveyed to the next
  static constexpr double allowedLateness = 1.2; ///< as a multiple of the budget

  struct Count
  {
    int frames = 0;
    int possible = 0;
    int late = 0; ///< possible frames where `auto` is late
  };

  double draw(Runner& runner, int frame)
  {
    runner.place(this->camera_, 360.0 * frame / frames);
    return runner.draw();
  }

  VisibilityImages visibility(Runner& runner, int frame)
  {
    runner.place(this->camera_, 360.0 * frame / frames);
    return runner.visibility();
  }

  /// Time plain VTK, and find the coarsest map that keeps the error, along the way.
  void survey()
  {
    for (int frame = 0; frame < frames; frame += surveyed)
    {
      this->plain_.milliseconds.push_back(this->draw(this->plain_, frame));
      const VisibilityImages truth = this->visibility(this->rays_, frame);
      Runner* coarsest = nullptr;
      for (std::size_t i = 0; i < this->maps_.size() && !coarsest; ++i)
      {
        Runner& map = *this->maps_[i];
        const VisibilityError off =
          measureError(this->visibility(map, frame), truth, this->scene_.lights);
        coarsest = off.share(off.wrongPixels()) <= this->options_.error ? &map : nullptr;
      }
      this->coarsest_.push_back(coarsest);
    }
  }

  /// @return milliseconds of the fastest single technique that keeps the error
  double best(int frame)
  {
    const double byRays = this->draw(this->rays_, frame);
    Runner* const map = this->coarsest_[static_cast<std::size_t>(frame / surveyed)];
    return map ? std::min(byRays, this->draw(*map, frame)) : byRays;
  }

  void count(Count& count, double milliseconds, double best)
  {
    const double latest = allowedLateness * this->budget_;
    const bool isPossible = best <= latest;
    ++count.frames;
    count.possible += isPossible ? 1 : 0;
    count.late += isPossible && milliseconds > latest ? 1 : 0;
    const std::string technique = this->automatic_.variant.pass()->GetReport().lights[0].technique;
    this->changes_ += !this->before_.empty() && this->before_ != technique ? 1 : 0;
    this->before_ = technique;
    ++this->taken_[technique];
  }

  const Scene& scene_;
  const Options& options_;
  Runner plain_, rays_, automatic_;
  std::vector<std::unique_ptr<Runner>> maps_; ///< from coarse to fine
  std::vector<Runner*> coarsest_;             ///< that keeps the error; null: none
  vtkNew<vtkCamera> camera_;
  double budget_ = 0.0; ///< milliseconds
  Count idle_, busy_;
  int changes_ = 0;
  std::map<std::string, int> taken_; ///< frames by technique
  std::string before_;               ///< technique of the frame before
};

int run(int argc, char** argv)
{
  CLI::App app{ "Measures how well auto chooses while the camera moves: a line per place",
    "gnomon_benchmark_auto" };
  Options options;
  app.add_option("SCENES", options.scenes, "Scenes: built-in names or scene files")->required();
  addNumber(app, "--places", options.places, 1, 100000, "Places of the camera in each scene");
  addNumber(app, "--compared", options.compared, 0, 100000,
    "At how many of them all techniques are timed; elsewhere auto's error alone is measured");
  app.add_option("--seed", options.seed, "Of the places")->capture_default_str();
  addNumber(app, "--size", options.sidePixels, 1, 16384, "Side of the window in pixels");
  addNumber(app, "--error", options.error, 0.0, 1.0, "The share of wrong pixels that is allowed");
  addNumber(app, "--soft-error", options.softError, 0.0, 1.0,
    "The root mean square error that is allowed in scenes with area lights");
  addNumber(app, "--budget", options.budget, 0.0, 1e6,
    "Fly around each scene instead, with this multiple of plain VTK's time as a budget");
  CLI11_PARSE(app, argc, argv);

  const VtkMessages messages;
  std::cout << (options.budget > 0.0
      ? "scene,error,plain frames,budget ms,frames,possible,late,loaded,loaded possible,"
        "loaded late,changes,by maps,by rays\n"
      : "scene,place,technique,map texels,samples,allowed,error,ms,best ms,over best,best,why "
        "rays\n");
  for (const std::string& name : options.scenes)
  {
    const Scene scene = withoutShadowSettings(loadScene(name));
    options.budget > 0.0 ? Flight(scene, options).fly() : compareWithSingles(scene, options);
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
