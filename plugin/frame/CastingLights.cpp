#include "plugin/frame/CastingLights.h"

#include "lights/SettingsTable.h"
#include "shadowtech/base/TextureMemory.h"

#include <vtkLightCollection.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the value of a setting as text; empty if an estimator does not have it.
std::string valueOf(const char* setting, const TechniqueInfo& info, const ShadowLight& light)
{
  return has(info, setting) ? findSetting(setting)->get(light) : "";
}

/// True if an estimator needs no newer OpenGL than 3.2: it draws on the CPU, its maps included.
bool servesOldOpenGl(const TechniqueInfo& info)
{
  const bool drawsMaps = info.bakesMap() && !info.conservativeMap;
  return info.evaluation == Evaluation::ScreenCpu && !drawsMaps;
}

/// Return the names of the techniques for which that holds: "'a', 'b'".
std::string techniquesOfOldOpenGl()
{
  std::string names;
  for (const TechniqueEntry& technique : registry())
  {
    if (servesOldOpenGl(technique.estimator->info))
    {
      names += (names.empty() ? "'" : ", '") + technique.name + "'";
    }
  }
  return names;
}

/// Complete a light. If its technique traces no samples of an area, it shows the hard shadows of
/// the area's centre.
/// @param drawsMaps true if OpenGL is new enough for techniques on the GPU
Composition composeHere(ShadowLight light, bool drawsMaps)
{
  const EstimatorEntry* estimator = nullptr;
  try
  {
    estimator = &compose(light);
  }
  catch (const CompositionError& error)
  {
    return { std::move(light), nullptr, error.what() };
  }
  const TechniqueInfo& info = estimator->info;
  if (!drawsMaps && !servesOldOpenGl(info))
  {
    std::string refusal = "'" + light.technique +
      "' needs OpenGL 4.3, and this context has less; it suffices for " + techniquesOfOldOpenGl();
    return { std::move(light), nullptr, std::move(refusal) };
  }
  if (info.evaluation == Evaluation::ScreenCpu && !info.has(lightSampleSettings()))
  {
    light.area.reset();
  }
  return { std::move(light), estimator, {} };
}

/// Return the named settings, by name.
std::vector<const Setting*> namedSettings(const ShadowSettings& settings)
{
  std::vector<const Setting*> named;
  if (settings.named.any())
  {
    std::copy_if(shadowSettings().begin(), shadowSettings().end(), std::back_inserter(named),
      [&](const Setting* setting) { return settings.named[setting->index]; });
    std::sort(named.begin(), named.end(),
      [](const Setting* a, const Setting* b) { return a->name < b->name; });
  }
  return named;
}

/// True if a light's technique has a setting. A light that leaves its technique to the pass has the
/// settings of all techniques that the pass may choose, in this frame or another.
bool mayHave(const ShadowLight& light, const Setting& setting)
{
  const auto hasIt = [&](const char* technique)
  { return has(findTechnique(technique)->estimator->info, setting); };
  return has(estimatorOfLight(light).info, setting) ||
    (isAutomatic(light) && (hasIt(plainTechnique) || hasIt(restingHard) || hasIt(restingSoft)));
}

/// Return the errors of named settings that are without effect: a light's own that its technique
/// lacks, and those of the pass that every light's technique lacks.
std::vector<std::string> findMisfits(
  const std::vector<ShadowLight>& lights, const ShadowSettings& defaults)
{
  std::vector<std::string> misfits;
  for (const ShadowLight& light : lights)
  {
    for (const Setting* setting : namedSettings(light))
    {
      if (!mayHave(light, *setting))
      {
        misfits.push_back(
          nameOf(light) + " has the technique '" + light.technique + "', and " + whoHas(*setting));
      }
    }
  }
  for (const Setting* setting : namedSettings(defaults))
  {
    const auto isHad = [&](const ShadowLight& light) { return mayHave(light, *setting); };
    if (!lights.empty() && std::none_of(lights.begin(), lights.end(), isHad))
    {
      misfits.push_back("No light's technique has it: " + whoHas(*setting));
    }
  }
  return misfits;
}

Bounds visibleBounds(vtkRenderer* renderer)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  return { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
}

/// True if a cached technique may shade a light's translucent surfaces, or its next motion: its map
/// must not be one of a larger memory budget.
bool mayServeAsPlain(const LightPlan& plan, const EstimatorEntry& estimator)
{
  const bool isInBudget = !plan.asked || plan.asked->mapSizeTexels <= plan.mostMapTexels;
  return isInBudget && &estimator == findTechnique(plainTechnique)->estimator;
}

LightReport reportOfSkipped(const SkippedLight& skipped)
{
  LightReport report;
  report.sceneIndex = skipped.sceneIndex;
  report.reason = skipped.reason;
  return report;
}

LightReport reportOfCasting(const ShadowLight& light, const TechniqueInfo& info)
{
  LightReport report;
  report.sceneIndex = light.sceneIndex;
  report.casts = true;
  report.technique = light.technique;
  report.estimator = light.estimator;
  report.projection = valueOf("projection", info, light);
  report.mapSizeTexels = info.bakesMap() ? light.mapSizeTexels : 0;
  report.kernel = info.kernel.empty() ? valueOf("kernel", info, light) : info.kernel;
  report.kernelTexels = info.has(kernelSettings()) ? light.kernel.sizeTexels : 0;
  report.mapSamples = info.has(momentMapSettings()) ? light.momentMap.samples : 0;
  return report;
}

} // namespace

//------------------------------------------------------------------------------
bool isOnCpu(const CastingLight& casting)
{
  return casting.own->info().evaluation == Evaluation::ScreenCpu;
}

//------------------------------------------------------------------------------
std::size_t edgeSamplesOf(const CastingLight& casting)
{
  return edgeSamplesOf(casting.own->info(), casting.light);
}

//------------------------------------------------------------------------------
bool smoothsEdges(const CastingLights& lights)
{
  return std::any_of(lights.begin(), lights.end(),
    [](const CastingLight& casting) { return edgeSamplesOf(casting) > 1; });
}

//------------------------------------------------------------------------------
bool canDrawMaps()
{
  return GNOMON_HAS_GL(VERSION_4_3);
}

//------------------------------------------------------------------------------
void CastingLights::collect(vtkRenderer* renderer, const ShadowSettings& defaults,
  const FrameWishes& wishes, TechniqueCache& ofView, FrameReport& report)
{
  const bool drawsMaps = canDrawMaps();
  SceneLights scene;
  scene.set = this->manager_.collect(renderer, defaults, wishes.casting);
  scene.compose = this->compose_ = [drawsMaps](ShadowLight light)
  { return composeHere(std::move(light), drawsMaps); };
  scene.drawsMaps = drawsMaps;
  if (drawsMaps &&
    std::any_of(scene.set.lights.begin(), scene.set.lights.end(),
      [](const ShadowLight& light) { return light.momentMap.samples > 1; }))
  {
    scene.mostMapSamples = mostMapSamples();
  }
  if (wishes.memoryBudget > 0.0)
  {
    const int* const size = renderer->GetSize();
    scene.pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    scene.seenWorld = visibleBounds(renderer);
  }
  report.headlightIsAlone = scene.set.headlightIsAlone;
  if (scene.set.headlightIsAlone)
  {
    report.notes.push_back("no shadow can be seen: all light comes from the camera. Add a light "
                           "from the side");
  }
  report.misfits = findMisfits(scene.set.lights, defaults);
  if (renderer->GetLights()->GetNumberOfItems() == 0)
  {
    report.notes.push_back("no light: VTK shades nothing, and nothing casts");
  }

  LightPlans plans = planLights(std::move(scene), wishes);
  report.misfits.insert(report.misfits.end(), plans.misfits.begin(), plans.misfits.end());
  report.notes.insert(report.notes.end(), plans.notes.begin(), plans.notes.end());
  for (const LightPlan& plan : plans.lights)
  {
    report.lights.push_back(reportOfCasting(plan.light, plan.estimator->info));
    report.lights.back().budgetReason = plan.budgetReason;
  }
  std::transform(
    plans.skipped.begin(), plans.skipped.end(), std::back_inserter(report.lights), reportOfSkipped);
  std::sort(report.lights.begin(), report.lights.end(),
    [](const LightReport& a, const LightReport& b) { return a.sceneIndex < b.sceneIndex; });

  this->ofView_ = &ofView;
  this->lights_.clear();
  for (TechniqueCache* const cache : { &this->ofAllViews_, this->ofView_ })
  {
    cache->dropUnless(
      [&](int sceneIndex, const EstimatorEntry& estimator)
      {
        const auto plan = std::find_if(plans.lights.begin(), plans.lights.end(),
          [&](const LightPlan& of) { return of.light.sceneIndex == sceneIndex; });
        return plan != plans.lights.end() && &this->cacheOf(plan->light) == cache &&
          (plan->estimator == &estimator || mayServeAsPlain(*plan, estimator));
      });
  }
  for (LightPlan& plan : plans.lights)
  {
    CastingLight& casting = this->lights_.emplace_back();
    casting.own = &this->cacheOf(plan.light).of(plan.light.sceneIndex, *plan.estimator);
    casting.identity = identityOf(plan.light);
    casting.channels = channelsOf(plan.estimator->info, plan.light);
    casting.light = std::move(plan.light);
    casting.asked = std::move(plan.asked);
    casting.mostMapTexels = plan.mostMapTexels;
  }
  this->placeVisibility();
}

//------------------------------------------------------------------------------
void CastingLights::enter(const SceneFrame& frame, FrameReport& report)
{
  const auto isSkipped = [&](CastingLight& casting)
  {
    const std::string reason = enterFrame(casting.light, frame);
    casting.identity = identityOf(casting.light);
    if (casting.asked)
    {
      enterFrame(*casting.asked, frame);
    }
    if (!reason.empty())
    {
      reportOf(report, casting.light) = reportOfSkipped({ casting.light.sceneIndex, reason });
    }
    return !reason.empty();
  };
  this->lights_.erase(
    std::remove_if(this->lights_.begin(), this->lights_.end(), isSkipped), this->lights_.end());
  this->placeVisibility();
}

//------------------------------------------------------------------------------
/// Assign layers, and bits to lights with hard shadows.
void CastingLights::placeVisibility()
{
  this->layers_ = 0;
  this->bits_ = 0;
  for (CastingLight& casting : this->lights_)
  {
    casting.layer = 0;
    casting.bit = noBit;
    if (isBit(casting.own->info(), casting.light) && this->bits_ < VisibilityLayers::mostBits)
    {
      casting.bit = this->bits_++;
    }
    else
    {
      casting.layer = this->layers_;
      this->layers_ += casting.channels;
    }
  }
}

//------------------------------------------------------------------------------
void CastingLights::take(CastingLight& casting, Composition other, FrameReport& report)
{
  casting.own = &this->techniqueOf(other);
  casting.light = std::move(other.light);
  casting.identity = identityOf(casting.light);
  casting.channels = channelsOf(casting.own->info(), casting.light);
  reportOf(report, casting.light) = reportOfCasting(casting.light, casting.own->info());
  this->placeVisibility();
}

//------------------------------------------------------------------------------
const PointwiseTechnique* CastingLights::pointwiseOn(
  CastingLight& casting, Route route, bool translucentReceivers)
{
  const PointwiseTechnique* own = casting.own->as<PointwiseTechnique>();
  if (own || !translucentReceivers)
  {
    return translucentReceivers || route == Route::Inline ? own : nullptr;
  }
  casting.plain = &this->cacheOf(casting.light)
                     .of(casting.light.sceneIndex, *findTechnique(plainTechnique)->estimator);
  return casting.plain->as<PointwiseTechnique>();
}

//------------------------------------------------------------------------------
void CastingLights::endFrame()
{
  const EstimatorEntry& plain = *findTechnique(plainTechnique)->estimator;
  for (const CastingLight& casting : this->lights_)
  {
    if (casting.asked && casting.asked->mapSizeTexels <= casting.mostMapTexels)
    {
      this->cacheOf(casting.light).keep(casting.light.sceneIndex, plain); // for the next motion
    }
  }
  this->ofAllViews_.dropUnused();
  if (this->ofView_)
  {
    this->ofView_->dropUnused();
  }
}

//------------------------------------------------------------------------------
/// Return the cache of a light's techniques. Maps that are fitted to a camera in every frame belong
/// to one view.
TechniqueCache& CastingLights::cacheOf(const ShadowLight& light)
{
  return isFittedToCamera(light) && light.fit != ViewFit::Once ? *this->ofView_ : this->ofAllViews_;
}

//------------------------------------------------------------------------------
LightReport& reportOf(FrameReport& report, const ShadowLight& light)
{
  return *std::find_if(report.lights.begin(), report.lights.end(),
    [&](const LightReport& of) { return of.sceneIndex == light.sceneIndex; });
}

} // namespace gnomon
