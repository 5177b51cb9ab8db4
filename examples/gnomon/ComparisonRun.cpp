#include "ComparisonRun.h"

#include "Errors.h"
#include "FrameTiming.h"
#include "FrameVariant.h"
#include "Machine.h"
#include "PictureVisibility.h"
#include "SettingOptions.h"

#include "lights/LightManager.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkVersion.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>

namespace gnomon::tool
{
namespace
{

/// Return the scene with lights as the plan defines them. The variants decide the rest.
Scene sceneOf(const ComparisonPlan& plan, const Scene& original)
{
  Scene scene = withoutShadowSettings(original);
  for (const auto& [name, value] : plan.settings)
  {
    if (!value.empty() && isOfLight(*findSetting(name)))
    {
      for (SceneLight& light : scene.lights)
      {
        light.settings[name] = value;
      }
    }
  }
  return scene;
}

/// Compose a variant's technique for each of the scene's lights.
/// @throws CompositionError if a light refuses the variant's settings
void requireComposition(const VariantSpec& spec, vtkRenderer* renderer)
{
  for (ShadowLight light : LightManager().collect(renderer, settingsOf(spec)).lights)
  {
    compose(light);
  }
}

/// Add the plan's settings that a variant's technique has, unless the variant sets them itself.
/// @return the resulting technique
/// @throws CompositionError if there is none
const TechniqueInfo& addSettings(const ComparisonPlan& plan, VariantSpec& spec)
{
  const auto choosesEstimator = [](const Setting& setting)
  { return setting.name == "estimator" || setting.name == "as_published"; };
  // Settings that choose the estimator come first, as it decides which other settings there are.
  for (const bool choosing : { true, false })
  {
    const TechniqueInfo& info = estimatorOf(settingsOf(spec)).info;
    for (const auto& [name, value] : plan.settings)
    {
      const Setting& setting = *findSetting(name);
      if (!value.empty() && choosesEstimator(setting) == choosing && !isOfLight(setting) &&
        has(info, name))
      {
        spec.settings.emplace(name, value);
      }
    }
  }
  return estimatorOf(settingsOf(spec)).info;
}

/// Refuse unused settings.
/// @throws BadInput for a setting of the plan that no variant has
void requireUse(const ComparisonPlan& plan, const std::vector<VariantSpec>& specs)
{
  for (const auto& [name, value] : plan.settings)
  {
    const auto hasIt = [&name = name](const VariantSpec& spec)
    { return spec.settings.count(name); };
    if (!value.empty() && !isOfLight(*findSetting(name)) &&
      std::none_of(specs.begin(), specs.end(), hasIt))
    {
      throw BadInput(
        optionOf(name) + ": " + whoHas(*findSetting(name)) + ", none of which is compared");
    }
  }
}

/// Return the plan's variants.
/// @param leftOut receives the reason for each technique that a light refuses
/// @throws BadInput if a light refuses the truth
std::vector<VariantSpec> listVariants(
  const ComparisonPlan& plan, const Scene& scene, std::vector<std::string>& leftOut)
{
  std::vector<VariantSpec> specs;
  specs.push_back({ plainTechnique });
  for (int size : plan.mapSizesTexels)
  {
    specs.push_back({ shadowMapPassTechnique, size });
  }
  std::vector<std::string> techniques = plan.techniques;
  if (std::find(techniques.begin(), techniques.end(), truthTechnique) == techniques.end())
  {
    techniques.push_back(truthTechnique);
  }
  const vtkSmartPointer<vtkRenderer> renderer =
    makeRenderer(scene, static_cast<double>(plan.width) / plan.height);
  for (const std::string& text : techniques)
  {
    VariantSpec spec = parseTechnique(text);
    const TechniqueInfo* info = nullptr;
    try
    {
      info = &addSettings(plan, spec);
      requireComposition(spec, renderer);
    }
    catch (const CompositionError& error)
    {
      if (text == truthTechnique)
      {
        throw BadInput(text + ", the truth for all techniques: " + error.what());
      }
      leftOut.push_back(text + " is left out: " + error.what() + ".");
      continue;
    }
    spec.pointwise = info->isPointwise();
    for (int size : info->bakesMap() ? plan.mapSizesTexels : std::vector<int>{ 0 })
    {
      spec.mapSizeTexels = size;
      const bool takesInline = plan.usualRoute ? !info->isSlow : plan.inlineRoute;
      const bool takesImage = plan.usualRoute ? info->isSlow : plan.imageRoute;
      if (info->isPointwise() && takesInline)
      {
        spec.route = vtkGnomonShadowPass::ROUTE_INLINE;
        specs.push_back(spec);
      }
      if (!info->isPointwise() || takesImage)
      {
        spec.route =
          info->isPointwise() ? vtkGnomonShadowPass::ROUTE_IMAGE : vtkGnomonShadowPass::ROUTE_AUTO;
        specs.push_back(spec);
      }
    }
  }
  requireUse(plan, specs);
  return specs;
}

/// A variant and its measurements.
struct Variant : FrameVariant
{
  Variant(const VariantSpec& spec, const Scene& scene, const ComparisonPlan& plan)
    : FrameVariant(spec, scene, plan.width, plan.height)
  {
    this->result.name = spec.name();
    this->result.technique = spec.technique;
    this->result.route = spec.routeName();
    this->result.mapSizeTexels = spec.mapSizeTexels;
  }

  VariantResult result;
};

using Variants = std::vector<std::unique_ptr<Variant>>;

/// Return the sum of a frame's stages. A part ("stage: part") counts if its stage is not listed
/// itself.
double sumOfStages(const std::vector<StageTime>& stages)
{
  double sum = 0.0;
  for (const StageTime& stage : stages)
  {
    const std::size_t colon = stage.name.find(": ");
    const bool included = colon != std::string::npos &&
      std::any_of(stages.begin(), stages.end(),
        [&stage, colon](const StageTime& other)
        { return other.name == stage.name.substr(0, colon); });
    sum += included ? 0.0 : stage.milliseconds;
  }
  return sum;
}

/// Collects the stage times of measured frames.
class StageSamples
{
public:
  void add(const std::vector<StageTime>& stages, double wallMilliseconds)
  {
    for (const StageTime& stage : stages)
    {
      if (this->samples_.find(stage.name) == this->samples_.end())
      {
        this->order_.push_back(stage.name);
      }
      this->samples_[stage.name].push_back(stage.milliseconds);
    }
    if (!stages.empty())
    {
      this->shares_.push_back(sumOfStages(stages) / wallMilliseconds);
    }
  }

  void store(MotionTiming& timing) const
  {
    for (const std::string& name : this->order_)
    {
      std::vector<double> times = this->samples_.at(name);
      times.resize(this->shares_.size(), 0.0); // 0 for frames without the stage
      timing.stages.emplace_back(name, median(times));
    }
    timing.stageShare = median(this->shares_);
  }

private:
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> samples_;
  std::vector<double> shares_;
};

/// The side of a variant's worst place, in pixels.
constexpr int worstPlacePixels = 64;

/// Counts steps of work with similar durations.
class StepCounter
{
public:
  StepCounter(std::size_t total, const ComparisonEvents& events)
    : total_(total)
    , events_(events)
  {
  }
  /// Count a finished step and report it.
  /// @param step the step, for users
  void advance(const std::string& step)
  {
    ++this->done_;
    if (this->events_.progress)
    {
      this->events_.progress(
        static_cast<double>(this->done_) / static_cast<double>(this->total_), step);
    }
  }

private:
  std::size_t total_;
  std::size_t done_ = 0;
  const ComparisonEvents& events_;
};

/// Return a text such as "3 of 8 rows".
std::string countOfRows(std::size_t count, std::size_t all)
{
  return std::to_string(count) + " of " + std::to_string(all) + " rows";
}

/// Return a text such as "timing 8 rows, camera moving".
std::string timingStep(const Variants& variants, Motion motion)
{
  return "timing " + std::to_string(variants.size()) + " rows, " + motionName(motion);
}

/// Return the number of frames per motion whose stages are timed.
int measuredFrames(const ComparisonPlan& plan)
{
  return std::clamp(plan.frames / 3, 1, 9);
}

/// Return the number of frames per variant and motion, warm-up frames included.
std::size_t framesPerMotion(const ComparisonPlan& plan)
{
  return plan.frames > 0
    ? static_cast<std::size_t>(warmUpFrames + plan.frames + measuredFrames(plan))
    : 0;
}

void timeWholeFrames(
  Variants& variants, Motion motion, const ComparisonPlan& plan, StepCounter& steps)
{
  std::vector<FrameVariant*> drawn;
  std::transform(variants.begin(), variants.end(), std::back_inserter(drawn),
    [](const std::unique_ptr<Variant>& variant) { return variant.get(); });
  const std::vector<double> medians =
    timeFrames(drawn, motion, plan.frames, [&] { steps.advance(timingStep(variants, motion)); });
  for (std::size_t i = 0; i < variants.size(); ++i)
  {
    variants[i]->result.timings[static_cast<std::size_t>(motion)].milliseconds = medians[i];
  }
}

void timeStages(Variants& variants, Motion motion, const ComparisonPlan& plan, StepCounter& steps)
{
  std::vector<StageSamples> samples(variants.size());
  const int firstStep = warmUpFrames + plan.frames + 1;
  for (int frame = 0; frame < measuredFrames(plan); ++frame)
  {
    for (std::size_t i = 0; i < variants.size(); ++i)
    {
      if (vtkGnomonShadowPass* const pass = variants[i]->pass())
      {
        pass->MeasureStagesOn();
        const double milliseconds = variants[i]->drawFrame(motion, firstStep + frame);
        samples[i].add(pass->GetReport().stages, milliseconds);
        pass->MeasureStagesOff();
      }
    }
    steps.advance(timingStep(variants, motion));
  }
  for (std::size_t i = 0; i < variants.size(); ++i)
  {
    samples[i].store(variants[i]->result.timings[static_cast<std::size_t>(motion)]);
  }
}

/// Render the first frames: compile shaders, build structures, bake all maps, and measure the
/// process' growth.
void warmUp(Variant& variant)
{
  const std::int64_t before = residentBytes();
  for (int frame = 0; frame < warmUpFrames; ++frame)
  {
    variant.drawFrame(Motion::Static, 0);
  }
  // Frames that compute visibility wait for maps. Maps fitted to a moving camera never come.
  constexpr int mostFrames = 64;
  for (int frame = 1; frame <= mostFrames && variant.awaitsMap(); ++frame)
  {
    variant.drawFrame(Motion::Camera, frame);
  }
  variant.drawFrame(Motion::Static, 0);
  VariantResult& result = variant.result;
  result.memory.residentGrowth = residentBytes() - before;
  if (variant.pass())
  {
    const FrameReport& report = variant.pass()->GetReport();
    result.memory.occluders = report.bytesOccluders;
    result.memory.bvh = report.bytesBvh;
    result.memory.maps = report.bytesMaps;
    result.memory.images = report.bytesImages;
    result.notes = report.notes;
  }
}

/// Return the visibility that a variant exports for the scene at rest.
VisibilityImages keptVisibility(Variant& variant)
{
  variant.pass()->KeepVisibilityOn();
  do
  {
    variant.drawFrame(Motion::Static, 0);
  } while (variant.pass()->GetProgress() < 1.0);
  VisibilityImages images = variant.pass()->GetVisibility();
  variant.pass()->KeepVisibilityOff();
  return images;
}

/// True if one of the casting lights has an area, and so has soft shadows.
bool hasSoftShadows(vtkRenderer* renderer, const ShadowSettings& settings)
{
  const std::vector<ShadowLight> lights = LightManager().collect(renderer, settings).lights;
  return std::any_of(
    lights.begin(), lights.end(), [](const ShadowLight& light) { return light.area.has_value(); });
}

bool isSoft(const Variant& variant)
{
  return hasSoftShadows(variant.renderer(), settingsOf(variant.spec()));
}

/// Return the first seed, from 1, that no variant uses.
std::string unusedSeed(const Variants& variants)
{
  const auto has = [](const std::unique_ptr<Variant>& variant, int seed)
  { return variant->pass() && variant->pass()->GetSetting("light_seed") == std::to_string(seed); };
  int seed = 1;
  while (std::any_of(variants.begin(), variants.end(),
    [&](const std::unique_ptr<Variant>& variant) { return has(variant, seed); }))
  {
    ++seed;
  }
  return std::to_string(seed);
}

/// Return the truth for all variants. Ray-traced shadows of area lights have a sampling error, so
/// the truth uses evenly spread samples that no variant uses.
VisibilityImages truthOf(
  Variant& variant, const Variants& variants, int samples, std::vector<std::string>& notes)
{
  if (!isSoft(variant))
  {
    return keptVisibility(variant);
  }
  const std::map<std::string, std::string> ofTruth = truthSettings(samples, unusedSeed(variants));
  std::map<std::string, std::string> ofVariant;
  for (const auto& [name, value] : ofTruth)
  {
    ofVariant[name] = variant.pass()->GetSetting(name.c_str());
    variant.pass()->SetSetting(name.c_str(), value.c_str());
  }
  VisibilityImages truth = keptVisibility(variant);
  for (const auto& [name, value] : ofVariant)
  {
    variant.pass()->SetSetting(name.c_str(), value.c_str());
  }
  notes.push_back("The truth has " + ofTruth.at("light_samples") +
    " samples of each area light for every pixel, with light_seed " + ofTruth.at("light_seed") +
    ".");
  return truth;
}

VisibilityImages withoutShadows(const VisibilityImages& truth)
{
  VisibilityImages images = truth;
  for (std::vector<float>& plane : images.visibility)
  {
    std::fill(plane.begin(), plane.end(), 1.0f);
  }
  return images;
}

/// Return the visibility of a variant that shades with it but does not export it.
VisibilityImages visibilityFromItsPictures(
  Variant& variant, const Scene& scene, const VisibilityImages& truth)
{
  const VariantSpec& spec = variant.spec();
  PictureVisibility found = measureVisibility(
    scene, truth, [&spec](vtkRenderer* renderer) { renderer->SetPass(makePass(spec)); });
  variant.result.errorSource =
    "Measured from its pictures of the scene with white surfaces, without ambient light and gloss, "
    "under one light at a time. Visibility is the quotient of a picture with shadows and one "
    "without. Four exposures keep faintly lit surfaces above the steps of 8 bits. " +
    std::to_string(found.unreadable) +
    " pixels at grazing angles are still black; they count as right.";
  return std::move(found.images);
}

VisibilityImages visibilityOf(Variant& variant, const Scene& scene, const VisibilityImages& truth)
{
  const VariantSpec& spec = variant.spec();
  if (spec.technique == plainTechnique)
  {
    variant.result.errorSource = "By definition: it lights everything, so its visibility is 1.";
    return withoutShadows(truth);
  }
  if (!spec.isGnomon() || spec.route == vtkGnomonShadowPass::ROUTE_INLINE)
  {
    return visibilityFromItsPictures(variant, scene, truth);
  }
  variant.result.errorSource = spec.technique == truthTechnique && !isSoft(variant)
    ? "It is the truth."
    : "From its visibility image, one number per pixel and light.";
  return keptVisibility(variant);
}

/// Store the classes of a variant's pixels in its result.
void takeClasses(VariantResult& result, const FrameReport& report, const VisibilityImages& images)
{
  for (const LightReport& light : report.lights)
  {
    result.tracedPixels += light.tracedPixels;
    for (const ClassCount& of : light.classes)
    {
      const auto same = std::find_if(result.classes.begin(), result.classes.end(),
        [&](const auto& entry) { return entry.first == of.name; });
      if (same == result.classes.end())
      {
        result.classes.emplace_back(of.name, of.pixels);
      }
      else
      {
        same->second += of.pixels;
      }
    }
  }
  const auto told = std::find_if(images.classes.begin(), images.classes.end(),
    [](const ClassImage& image) { return !image.classes.empty(); });
  if (told != images.classes.end())
  {
    result.classPicture =
      classPicture(images, static_cast<std::size_t>(told - images.classes.begin()));
  }
}

void measureErrors(
  Variants& variants, const Scene& scene, const VisibilityImages& truth, StepCounter& steps)
{
  std::size_t done = 0;
  for (const std::unique_ptr<Variant>& variant : variants)
  {
    VariantResult& result = variant->result;
    if (variant->pass() && has(estimatorOf(settingsOf(variant->spec())).info, "bake"))
    {
      // Counts are those of techniques with their maps, even if baking these does not pay.
      variant->pass()->SetSetting("bake", "always");
    }
    variant->drawFrame(Motion::Static, 0);
    result.picture = capture(variant->window());
    const VisibilityImages visibility = visibilityOf(*variant, scene, truth);
    std::vector<PixelVerdict> verdicts;
    std::vector<float> differences;
    result.error = measureError(visibility, truth, scene.lights, &verdicts, &differences);
    result.worst = worstPlace(differences, truth.width, truth.height, worstPlacePixels);
    std::vector<unsigned char> traced(verdicts.size(), 0);
    if (variant->pass() && result.route != "inline")
    {
      takeClasses(result, variant->pass()->GetReport(), visibility);
      traced = tracedMask(visibility);
    }
    result.errors = errorPicture(result.picture, verdicts, &traced);
    steps.advance(countOfRows(++done, variants.size()) + " done");
  }
}

void requireCastingLights(const Scene& scene, const FrameReport& report)
{
  std::string reasons;
  for (const LightReport& light : report.lights)
  {
    if (light.casts)
    {
      return;
    }
    reasons += "; light " + std::to_string(light.sceneIndex) + ": " + light.reason;
  }
  throw BadInput(
    scene.name + ": no light casts a shadow, expected at least one to compare" + reasons);
}

void describeScene(ComparisonResults& results, const Scene& scene, const FrameReport& report)
{
  results.triangles = report.triangles;
  results.notes = scene.notes;
  for (const LightReport& light : report.lights)
  {
    results.lights += light.casts;
    if (!light.casts)
    {
      results.notes.push_back(
        "Light " + std::to_string(light.sceneIndex) + " casts no shadow: " + light.reason + ".");
    }
  }
  if (std::any_of(scene.models.begin(), scene.models.end(),
        [](const SceneModel& model) { return !model.casts || !model.receives || model.oneSided; }))
  {
    results.notes.push_back(
      "Some models of the scene do not cast, do not receive or are one-sided. "
      "vtkShadowMapPass has no such settings and shadows them all alike.");
  }
}

/// Return the settings that the numbers depend on.
std::vector<std::pair<std::string, std::string>> listSettings(
  const ComparisonPlan& plan, vtkRenderWindow* window)
{
  std::vector<std::pair<std::string, std::string>> settings = {
    { "Window",
      std::to_string(plan.width) + " x " + std::to_string(plan.height) +
        " pixels, one sample per pixel" },
    { "Timed frames",
      plan.frames > 0 ? std::to_string(plan.frames) + " per variant and motion, after " +
          std::to_string(warmUpFrames) + " for warming up, and " +
          std::to_string(measuredFrames(plan)) + " by stage; " +
          "camera and lights turn by 0.05 degrees per frame"
                      : "none" },
    { "Gnomon", GNOMON_VERSION },
    { "VTK", vtkVersion::GetVTKVersion() },
    { "OpenGL", openGlName(window) },
    { "Processor", processorName() },
    { "Resident set at the end", std::to_string(residentBytes() / (1024 * 1024)) + " MB" },
  };
  for (const auto& [name, value] : plan.settings)
  {
    if (!value.empty() && isOfLight(*findSetting(name)))
    {
      settings.emplace_back("Of all lights", name + " " + value);
    }
  }
  return settings;
}

std::string firstPanelTitle(const std::string& technique)
{
  return technique == plainTechnique ? technique + ": no shadows"
    : technique == truthTechnique    ? "the truth: Gnomon's " + technique
                                     : "VTK's own: " + technique;
}

/// Return small pictures of the peers and the truth.
std::vector<Panel> drawFirstPanels(const ComparisonPlan& plan, const Scene& scene)
{
  ComparisonPlan first = plan;
  first.techniques = { truthTechnique };
  first.mapSizesTexels.resize(std::min<std::size_t>(1, plan.mapSizesTexels.size()));
  const double scale =
    std::min(1.0, static_cast<double>(firstPanelPixels) / std::max(plan.width, plan.height));
  first.width = std::max(1, static_cast<int>(plan.width * scale));
  first.height = std::max(1, static_cast<int>(plan.height * scale));
  std::vector<Panel> panels;
  std::vector<std::string> leftOut;
  for (const VariantSpec& spec : listVariants(first, scene, leftOut))
  {
    FrameVariant variant(spec, scene, first.width, first.height);
    do
    {
      variant.drawFrame(Motion::Static, 0);
    } while (variant.pass() && variant.pass()->GetProgress() < 1.0);
    panels.push_back({ firstPanelTitle(spec.technique), capture(variant.window()) });
  }
  return panels;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<std::string> allTechniques()
{
  std::vector<std::string> names;
  for (const TechniqueEntry& entry : registry())
  {
    names.push_back(entry.name);
  }
  return names;
}

//------------------------------------------------------------------------------
std::map<std::string, std::string> truthSettings(int samples, const std::string& seed)
{
  return { { "light_samples", std::to_string(samples) }, { "light_seed", seed },
    { "light_sampling", "sobol" } };
}

//------------------------------------------------------------------------------
bool castsSoftShadows(const ComparisonPlan& plan, const Scene& scene)
{
  const Scene compared = sceneOf(plan, scene);
  return hasSoftShadows(
    makeRenderer(compared, static_cast<double>(plan.width) / plan.height), ShadowSettings());
}

//------------------------------------------------------------------------------
std::vector<std::string> usualTechniques(bool soft)
{
  return soft
    ? std::vector<std::string>{ "nsm", "pcf", "pcss", "sampled", "penumbra", truthTechnique }
    : std::vector<std::string>{ "nsm", "pcf", "vsm", "pssm", "silhouette", truthTechnique };
}

//------------------------------------------------------------------------------
ComparisonResults runComparison(
  const Scene& original, const ComparisonPlan& plan, const ComparisonEvents& events)
{
  const Scene scene = sceneOf(plan, original);
  std::vector<std::string> leftOut;
  const std::vector<VariantSpec> specs = listVariants(plan, scene, leftOut);
  StepCounter steps(2 * specs.size() + allMotions.size() * framesPerMotion(plan), events);
  if (events.firstPanels)
  {
    events.firstPanels(drawFirstPanels(plan, scene));
  }

  Variants variants;
  Variant* truthVariant = nullptr;
  for (const VariantSpec& spec : specs)
  {
    variants.push_back(std::make_unique<Variant>(spec, scene, plan));
    warmUp(*variants.back());
    if (spec.technique == truthTechnique)
    {
      truthVariant = variants.back().get();
    }
    steps.advance("set up " + countOfRows(variants.size(), specs.size()));
  }
  ComparisonResults results;
  requireCastingLights(scene, truthVariant->pass()->GetReport());
  describeScene(results, scene, truthVariant->pass()->GetReport());
  results.notes.insert(results.notes.end(), leftOut.begin(), leftOut.end());

  results.frames = plan.frames;
  for (Motion motion : timedMotions(results))
  {
    timeWholeFrames(variants, motion, plan, steps);
    timeStages(variants, motion, plan, steps);
  }
  const VisibilityImages truth = truthOf(*truthVariant, variants, plan.truthSamples, results.notes);
  measureErrors(variants, scene, truth, steps);

  results.scene = scene.name;
  results.width = plan.width;
  results.height = plan.height;
  results.truth = truthVariant->result.name;
  results.soft = isSoft(*truthVariant);
  results.settings = listSettings(plan, truthVariant->window());
  for (const std::unique_ptr<Variant>& variant : variants)
  {
    results.variants.push_back(std::move(variant->result));
  }
  return results;
}

} // namespace gnomon::tool
