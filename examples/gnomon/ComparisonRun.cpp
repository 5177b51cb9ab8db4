#include "ComparisonRun.h"

#include "Errors.h"
#include "Files.h"
#include "FrameVariant.h"
#include "PictureVisibility.h"
#include "SettingOptions.h"
#include "VtkMessages.h"

#include "lights/LightManager.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkVersion.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace gnomon::tool
{
namespace
{

using Json = nlohmann::ordered_json;

/// Return the scene with lights as the plan defines them. The variants decide the rest.
Scene sceneOf(const ComparisonPlan& plan, const Scene& original)
{
  Scene scene = withoutShadowSettings(original);
  for (const auto& [name, value] : plan.settings)
  {
    for (SceneLight& light : scene.lights)
    {
      if (isOfLight(*findSetting(name)))
      {
        light.settings[name] = value;
      }
    }
  }
  return scene;
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
      if (choosesEstimator(setting) == choosing && !isOfLight(setting) && has(info, name))
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
    if (!isOfLight(*findSetting(name)) && std::none_of(specs.begin(), specs.end(), hasIt))
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
  std::vector<VariantSpec> specs = { { plainTechnique } };
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
      for (ShadowLight light : LightManager().collect(renderer, settingsOf(spec)).lights)
      {
        compose(light);
      }
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
    const int usualRoute =
      info->isSlow ? vtkGnomonShadowPass::ROUTE_IMAGE : vtkGnomonShadowPass::ROUTE_INLINE;
    for (int size : info->bakesMap() ? plan.mapSizesTexels : std::vector<int>{ 0 })
    {
      for (int route : !info->isPointwise() ? std::vector<int>{ vtkGnomonShadowPass::ROUTE_AUTO }
          : plan.routes.empty()             ? std::vector<int>{ usualRoute }
                                            : plan.routes)
      {
        spec.mapSizeTexels = size;
        spec.route = route;
        specs.push_back(spec);
      }
    }
  }
  requireUse(plan, specs);
  return specs;
}

struct Variant : FrameVariant
{
  Variant(const VariantSpec& spec, const Scene& scene, const ComparisonPlan& plan)
    : FrameVariant(spec, scene, plan.width, plan.height)
    , json{ { "name", spec.name() }, { "technique", spec.technique }, { "route", spec.routeName() },
      { "map_size", spec.mapSizeTexels }, { "error", Json::object() }, { "traced_pixels", 0 } }
  {
    if (plan.frames > 0)
    {
      this->json["times"] = Json::object();
    }
  }

  Json json;
  VariantPictures pictures;
};

using Variants = std::vector<std::unique_ptr<Variant>>;

/// Return the sum of a frame's stages. A part ("stage: part") counts if its stage is not listed
/// itself.
double sumOfStages(const std::vector<StageTime>& stages)
{
  double sum = 0.0;
  for (const StageTime& stage : stages)
  {
    const std::string whole = stage.name.substr(0, stage.name.find(": "));
    const bool included = whole != stage.name &&
      std::any_of(
        stages.begin(), stages.end(), [&](const StageTime& other) { return other.name == whole; });
    sum += included ? 0.0 : stage.milliseconds;
  }
  return sum;
}

/// Counts a finished step of work and reports it. Steps have similar durations.
using Advance = std::function<void(const std::string& step)>;

/// Return a text such as "3 of 8 rows".
std::string countOfRows(std::size_t count, std::size_t all)
{
  return std::to_string(count) + " of " + std::to_string(all) + " rows";
}

/// Return the number of frames per motion whose stages are timed.
int measuredFrames(const ComparisonPlan& plan)
{
  return std::clamp(plan.frames / 3, 1, 9);
}

/// Time whole frames, and then others by stage.
void timeMotion(
  Variants& variants, Motion motion, const ComparisonPlan& plan, const Advance& advance)
{
  const auto index = static_cast<std::size_t>(motion);
  const auto roundDone = [&]
  { advance("timing " + std::to_string(variants.size()) + " rows, " + motionNames[index]); };
  const std::vector<double> medians = timeFrames(
    variants.size(), plan.frames,
    [&](std::size_t i, int step) { return variants[i]->drawFrame(motion, step); }, roundDone);
  using Stages = nlohmann::ordered_map<std::string, std::vector<double>>;
  std::vector<Stages> stages(variants.size());
  std::vector<std::vector<double>> shares(variants.size());
  for (int frame = 0; frame < measuredFrames(plan); ++frame)
  {
    for (std::size_t i = 0; i < variants.size(); ++i)
    {
      vtkGnomonShadowPass* const pass = variants[i]->pass();
      if (!pass)
      {
        continue;
      }
      pass->MeasureStagesOn();
      const double milliseconds =
        variants[i]->drawFrame(motion, warmUpFrames + plan.frames + 1 + frame);
      const std::vector<StageTime>& measured = pass->GetReport().stages;
      for (const StageTime& stage : measured)
      {
        stages[i][stage.name].push_back(stage.milliseconds);
      }
      if (!measured.empty())
      {
        shares[i].push_back(sumOfStages(measured) / milliseconds);
      }
      pass->MeasureStagesOff();
    }
    roundDone();
  }
  for (std::size_t i = 0; i < variants.size(); ++i)
  {
    Json& timing = variants[i]->json["times"][motionKeys[index]];
    timing["frame_ms"] = medians[i];
    for (auto& [name, times] : stages[i])
    {
      times.resize(shares[i].size(), 0.0); // 0 for frames without the stage
      timing["stages_ms"][name] = median(times);
      timing["stage_share"] = median(shares[i]);
    }
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
  const FrameReport report = variant.pass() ? variant.pass()->GetReport() : FrameReport();
  // The growth includes software OpenGL's buffers, but not memory reused from earlier variants.
  variant.json["memory_bytes"] = { { "occluders", report.bytesOccluders },
    { "bvh", report.bytesBvh }, { "maps", report.bytesMaps }, { "images", report.bytesImages },
    { "resident_growth", residentBytes() - before } };
  variant.json["class_pixels"] = Json::object();
  variant.json["notes"] = report.notes;
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

/// Return the truth of area lights. Ray-traced shadows have a sampling error, so the truth uses
/// evenly spread samples that no variant uses.
VisibilityImages truthOfAreas(
  Variant& variant, const Variants& variants, int samples, std::vector<std::string>& notes)
{
  std::set<std::string> usedSeeds;
  for (const std::unique_ptr<Variant>& other : variants)
  {
    usedSeeds.insert(other->pass() ? other->pass()->GetSetting("light_seed") : "");
  }
  int seed = 1;
  while (usedSeeds.count(std::to_string(seed)) != 0)
  {
    ++seed;
  }
  std::map<std::string, std::string> settings = truthSettings(samples, std::to_string(seed));
  notes.push_back("The truth has " + settings.at("light_samples") +
    " samples of each area light for every pixel, with light_seed " + settings.at("light_seed") +
    ".");
  const auto exchange = [&]
  {
    for (auto& [name, value] : settings)
    {
      const std::string other = variant.pass()->GetSetting(name.c_str());
      variant.pass()->SetSetting(name.c_str(), value.c_str());
      value = other;
    }
  };
  exchange();
  VisibilityImages truth = keptVisibility(variant);
  exchange();
  return truth;
}

/// Return a variant's visibility.
/// @param source receives its source, as a sentence
VisibilityImages visibilityOf(Variant& variant, const Scene& scene, const VisibilityImages& truth,
  bool soft, std::string& source)
{
  const VariantSpec& spec = variant.spec();
  if (spec.technique == plainTechnique)
  {
    source = "By definition: it lights everything, so its visibility is 1.";
    VisibilityImages images = truth;
    images.classes.clear();
    for (std::vector<float>& plane : images.visibility)
    {
      plane.assign(plane.size(), 1.0f);
    }
    return images;
  }
  if (spec.isGnomon() && spec.route != vtkGnomonShadowPass::ROUTE_INLINE)
  {
    source = spec.technique == truthTechnique && !soft
      ? "It is the truth."
      : "From its visibility image, one number per pixel and light.";
    return keptVisibility(variant);
  }
  PictureVisibility found = measureVisibility(
    scene, truth, [&spec](vtkRenderer* renderer) { renderer->SetPass(makePass(spec)); });
  source =
    "Measured from its pictures of the scene with white surfaces, without ambient light and gloss, "
    "under one light at a time. Visibility is the quotient of a picture with shadows and one "
    "without. Four exposures keep faintly lit surfaces above the steps of 8 bits. " +
    std::to_string(found.unreadable) +
    " pixels at grazing angles are still black; they count as right.";
  return std::move(found.images);
}

void takeClasses(Variant& variant, const VisibilityImages& images)
{
  std::int64_t traced = 0;
  nlohmann::ordered_map<std::string, std::int64_t> classes;
  for (const LightReport& light : variant.pass()->GetReport().lights)
  {
    traced += light.tracedPixels;
    for (const ClassCount& of : light.classes)
    {
      classes[of.name] += of.pixels;
    }
  }
  variant.json["traced_pixels"] = traced;
  variant.json["class_pixels"] = Json(classes);
  variant.pictures.classes = classPicture(images);
}

/// Measure a variant's error, and take its pictures.
void measureVariant(Variant& variant, const Scene& scene, const VisibilityImages& truth, bool soft)
{
  if (variant.pass() && has(estimatorOf(settingsOf(variant.spec())).info, "bake"))
  {
    // Counts are those of techniques with their maps, even if baking these does not pay.
    variant.pass()->SetSetting("bake", "always");
  }
  variant.drawFrame(Motion::Static, 0);
  variant.pictures.picture = capture(variant.window());
  std::string source;
  const VisibilityImages images = visibilityOf(variant, scene, truth, soft, source);
  const VisibilityError error = measureError(images, truth, scene.lights);
  variant.json["error"] = { { "source", source }, { "facing_pixels", error.facingPixels },
    { "wrong_pixels", error.wrongPixels() }, { "wrong_share", error.share(error.wrongPixels()) },
    { "false_light_pixels", error.falseLight }, { "false_shadow_pixels", error.falseShadow },
    { "mean_absolute_error", error.meanAbsolute }, { "rms_error", error.rootMeanSquare },
    { "between_pixels", error.betweenPixels },
    { "between_share", error.share(error.betweenPixels) } };
  if (variant.pass() && variant.spec().route != vtkGnomonShadowPass::ROUTE_INLINE)
  {
    takeClasses(variant, images);
  }
  constexpr int placePixels = 64;
  variant.pictures.worst = worstPlace(error.differences, truth.width, truth.height, placePixels);
  variant.pictures.errors = errorPicture(variant.pictures.picture, error.verdicts);
  const std::string stem = fileStem(variant.spec().name());
  variant.json["picture"] = stem + ".png";
  variant.json["error_picture"] = stem + "-errors.png";
  if (variant.pictures.classes.pixelCount() > 0)
  {
    variant.json["class_picture"] = stem + "-classes.png";
  }
}

/// Return the notes about a scene.
/// @param castingLights receives their number
/// @throws BadInput if no light casts a shadow
std::vector<std::string> notesOf(const Scene& scene, const FrameReport& report, int& castingLights)
{
  std::vector<std::string> notes = scene.notes;
  std::string reasons;
  for (const LightReport& light : report.lights)
  {
    const std::string number = std::to_string(light.sceneIndex);
    castingLights += light.casts;
    if (!light.casts)
    {
      notes.push_back("Light " + number + " casts no shadow: " + light.reason + ".");
      reasons += "; light " + number + ": " + light.reason;
    }
  }
  if (castingLights == 0)
  {
    throw BadInput(
      scene.name + ": no light casts a shadow, expected at least one to compare" + reasons);
  }
  if (std::any_of(scene.models.begin(), scene.models.end(),
        [](const SceneModel& model) { return !model.casts || !model.receives || model.oneSided; }))
  {
    notes.push_back("Some models of the scene do not cast, do not receive or are one-sided. "
                    "vtkShadowMapPass has no such settings and shadows them all alike.");
  }
  return notes;
}

/// Return the settings that the numbers depend on, for users.
Json settingsOf(const ComparisonPlan& plan, vtkRenderWindow* window)
{
  Json settings = {
    { "Window",
      std::to_string(plan.width) + " x " + std::to_string(plan.height) +
        " pixels, one sample per pixel" },
    { "Timed frames",
      plan.frames > 0 ? std::to_string(plan.frames) + " per variant and motion, after " +
          std::to_string(warmUpFrames) + " for warming up, and " +
          std::to_string(measuredFrames(plan)) +
          " by stage; camera and lights turn by 0.05 degrees per frame"
                      : "none" },
    { "Gnomon", GNOMON_VERSION },
    { "VTK", vtkVersion::GetVTKVersion() },
    { "OpenGL", openGlName(window) },
    { "Processor", processorName() },
    { "Resident set at the end", std::to_string(residentBytes() / (1024 * 1024)) + " MB" },
  };
  std::string ofLights;
  for (const auto& [name, value] : plan.settings)
  {
    ofLights += isOfLight(*findSetting(name)) ? ", " + name + " " + value : "";
  }
  if (!ofLights.empty())
  {
    settings["Of all lights"] = ofLights.substr(2);
  }
  return settings;
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
    const std::string title = spec.technique == plainTechnique ? spec.technique + ": no shadows"
      : spec.isGnomon() ? "the truth: Gnomon's " + spec.technique
                        : "VTK's own: " + spec.technique;
    panels.push_back({ title, capture(variant.window()) });
  }
  return panels;
}

} // namespace

std::vector<std::string> allTechniques()
{
  std::vector<std::string> names;
  for (const TechniqueEntry& entry : registry())
  {
    names.push_back(entry.name);
  }
  return names;
}

std::map<std::string, std::string> truthSettings(int samples, const std::string& seed)
{
  return { { "light_samples", std::to_string(samples) }, { "light_seed", seed },
    { "light_sampling", "sobol" } };
}

bool castsSoftShadows(const ComparisonPlan& plan, const Scene& scene)
{
  const vtkSmartPointer<vtkRenderer> renderer =
    makeRenderer(sceneOf(plan, scene), static_cast<double>(plan.width) / plan.height);
  const std::vector<ShadowLight> lights = LightManager().collect(renderer, ShadowSettings()).lights;
  return std::any_of(
    lights.begin(), lights.end(), [](const ShadowLight& light) { return light.area.has_value(); });
}

std::vector<std::string> usualTechniques(bool soft)
{
  return soft
    ? std::vector<std::string>{ "nsm", "pcf", "pcss", "sampled", "penumbra", truthTechnique }
    : std::vector<std::string>{ "nsm", "pcf", "vsm", "pssm", "silhouette", truthTechnique };
}

ComparisonResults runComparison(
  const Scene& original, const ComparisonPlan& plan, const ComparisonEvents& events)
{
  const VtkMessages messages;
  const Scene scene = sceneOf(plan, original);
  std::vector<std::string> leftOut;
  const std::vector<VariantSpec> specs = listVariants(plan, scene, leftOut);
  const int roundsPerMotion =
    plan.frames > 0 ? warmUpFrames + plan.frames + measuredFrames(plan) : 0;
  const double steps = 2.0 * static_cast<double>(specs.size()) +
    static_cast<double>(allMotions.size()) * roundsPerMotion;
  int done = 0;
  const Advance advance = [&](const std::string& step)
  {
    ++done;
    if (events.progress)
    {
      events.progress(done / steps, step);
    }
  };
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
    advance("set up " + countOfRows(variants.size(), specs.size()));
  }
  const FrameReport report = truthVariant->pass()->GetReport();
  int castingLights = 0;
  std::vector<std::string> notes = notesOf(scene, report, castingLights);
  notes.insert(notes.end(), leftOut.begin(), leftOut.end());
  for (const Motion motion : allMotions)
  {
    if (plan.frames > 0)
    {
      timeMotion(variants, motion, plan, advance);
    }
  }
  ComparisonResults results;
  results.soft = castsSoftShadows(plan, original);
  const VisibilityImages truth = results.soft
    ? truthOfAreas(*truthVariant, variants, plan.truthSamples, notes)
    : keptVisibility(*truthVariant);
  for (const std::unique_ptr<Variant>& variant : variants)
  {
    measureVariant(*variant, scene, truth, results.soft);
    results.pictures.push_back(std::move(variant->pictures));
    advance(countOfRows(results.pictures.size(), variants.size()) + " done");
  }
  results.json = { { "scene", scene.name }, { "width", plan.width }, { "height", plan.height },
    { "frames", plan.frames }, { "triangles", report.triangles },
    { "casting_lights", castingLights }, { "truth", truthVariant->spec().name() },
    { "settings", settingsOf(plan, truthVariant->window()) }, { "notes", notes } };
  for (const std::unique_ptr<Variant>& variant : variants)
  {
    results.json["variants"].push_back(variant->json);
  }
  if (!messages.errors().empty())
  {
    throw Failure("rendering " + scene.name + ": " + messages.errors().front());
  }
  return results;
}

} // namespace gnomon::tool
