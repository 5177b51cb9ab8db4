#include "plugin/frame/CastingLights.h"

#include "lights/LightPointSettings.h"
#include "lights/SettingsTable.h"
#include "plugin/frame/FrameWishes.h"
#include "plugin/frame/MemoryBudget.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/tracing/EdgeSettings.h"

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

/// Return the value of an integer setting; 0 if an estimator does not have it.
int numberOf(const char* setting, const TechniqueInfo& info, const ShadowLight& light)
{
  const std::string value = valueOf(setting, info, light);
  return value.empty() ? 0 : std::stoi(value);
}

/// Return the technique of lights that cannot have theirs.
const char* fallbackTechnique(const FrameWishes& wishes)
{
  return canDrawMaps() && !wishes.isShared ? plainTechnique : "raytraced";
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

/// Return the estimator of a light, and complete the light. If it traces no samples of an area, it
/// shows the hard shadows of the area's centre.
/// @throws CompositionError also if OpenGL is too old for it
const EstimatorEntry& composeHere(ShadowLight& light)
{
  const EstimatorEntry& estimator = compose(light);
  if (!canDrawMaps() && !servesOldOpenGl(estimator.info))
  {
    throw CompositionError("'" + light.technique +
      "' needs OpenGL 4.3, and this context has less; it suffices for " + techniquesOfOldOpenGl());
  }
  const TechniqueInfo& info = estimator.info;
  if (info.evaluation == Evaluation::ScreenCpu && !info.has(lightSampleSettings()))
  {
    light.area.reset();
  }
  return estimator;
}

/// Return a light's estimator, and complete the light. If its settings contradict each other or
/// OpenGL's version, use the fallback technique with the default settings.
const EstimatorEntry& composeIn(
  ShadowLight& light, const FrameWishes& wishes, std::vector<std::string>& misfits)
{
  try
  {
    return composeHere(light);
  }
  catch (const CompositionError& error)
  {
    misfits.push_back(nameOf(light) + ": " + error.what() + ". It uses '" +
      fallbackTechnique(wishes) + "' instead");
  }
  const int mapSizeTexels = light.mapSizeTexels;
  static_cast<ShadowSettings&>(light) = {};
  light.technique = fallbackTechnique(wishes);
  light.mapSizeTexels = mapSizeTexels;
  return compose(light);
}

/// Reduce a light's settings to OpenGL's limits, and note the effects.
void settle(ShadowLight& light, const TechniqueInfo& info, std::vector<std::string>& notes)
{
  const int samples = numberOf("map_samples", info, light);
  if (samples > 1 && samples > mostMapSamples())
  {
    const std::string most = std::to_string(mostMapSamples());
    notes.push_back(nameOf(light) + ": OpenGL supports at most " + most +
      " samples per texel of a map, not " + std::to_string(samples));
    findSetting("map_samples")->set(light, most);
  }
  if (light.texture && !info.seesTextures)
  {
    notes.push_back(nameOf(light) + ": '" + light.technique +
      "' shows an even light of its texture's mean colour");
  }
}

/// True if a light's technique has a setting. A light that leaves its technique to the pass has the
/// settings of all techniques that the pass may choose, in this frame or another.
bool mayHave(const ShadowLight& light, const std::string& settingName)
{
  const auto hasIt = [&](const char* technique)
  { return has(findTechnique(technique)->estimator->info, settingName); };
  return has(estimatorOfLight(light).info, settingName) ||
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
    for (const std::string& name : light.named)
    {
      if (!mayHave(light, name))
      {
        misfits.push_back(
          nameOf(light) + " has the technique '" + light.technique + "', and " + whoHas(name));
      }
    }
  }
  for (const std::string& name : defaults.named)
  {
    const auto isHad = [&](const ShadowLight& light) { return mayHave(light, name); };
    if (!lights.empty() && std::none_of(lights.begin(), lights.end(), isHad))
    {
      misfits.push_back("No light's technique has it: " + whoHas(name));
    }
  }
  return misfits;
}

/// Have a light's rays traced where several processes draw the picture: maps of one process know
/// its own casters alone.
void shareRays(ShadowLight& light, std::vector<std::string>& misfits)
{
  if (!isAutomatic(light) && light.technique != "raytraced")
  {
    misfits.push_back(nameOf(light) + ": '" + light.technique +
      "' sees the casters of one process, and several draw this picture. It uses 'raytraced' "
      "instead");
  }
  light.technique = "raytraced";
  light.estimator.clear();
  if (light.texture)
  {
    misfits.push_back(
      nameOf(light) + ": several processes draw this picture, in which it has no texture");
    light.texture.reset();
  }
}

/// A light with its estimator.
struct ComposedLight
{
  ShadowLight light;
  const EstimatorEntry* estimator = nullptr;
  std::optional<ShadowLight> asked; ///< as in CastingLight, like the next
  int mostMapTexels = std::numeric_limits<int>::max();
  std::string budgetReason; ///< as in LightReport
};

Bounds visibleBounds(vtkRenderer* renderer)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  return { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
}

/// Fit the lights to the memory budget.
/// @param skipped receives lights without room for a shadow
void keepBudget(std::vector<ComposedLight>& lights, vtkRenderer* renderer,
  const FrameWishes& wishes, std::vector<SkippedLight>& skipped, FrameReport& report)
{
  const Bounds seen = visibleBounds(renderer);
  const int* const size = renderer->GetSize();
  const std::size_t pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  std::vector<LightNeed> needs;
  for (const ComposedLight& of : lights)
  {
    needs.push_back(needOf(of.light, of.estimator->info, seen));
  }
  const bool mayBeInline = (wishes.route == RouteWish::Auto || wishes.route == RouteWish::Inline) &&
    !wishes.keepVisibility;
  const MemoryShares memory = shareMemory(needs, wishes.memoryBudget, pixels, mayBeInline);
  const auto automatic = std::count_if(
    lights.begin(), lights.end(), [](const ComposedLight& of) { return of.asked.has_value(); });

  std::vector<ComposedLight> casting;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    ComposedLight& of = lights[i];
    const LightShare& share = memory.lights[i];
    if (share.way == LightShare::Way::None)
    {
      skipped.push_back(
        { of.light.sceneIndex, "the memory budget has no room for an image of its visibility" });
      continue;
    }
    if (of.asked)
    {
      of.mostMapTexels = largestMapIn(memory.left / static_cast<double>(automatic), of.light);
    }
    if (share.way == LightShare::Way::Rays)
    {
      of.light.mapSizeTexels =
        std::min(of.light.mapSizeTexels, fewestTexels); // for translucent surfaces
      of.light.technique = "raytraced";
      of.light.estimator.clear();
      of.estimator = &composeIn(of.light, wishes, report.misfits);
      of.budgetReason =
        of.asked ? "" : "the memory budget has no room for its map, so rays replace it";
    }
    else if (share.mapSizeTexels < of.light.mapSizeTexels)
    {
      of.light.mapSizeTexels = share.mapSizeTexels;
      of.budgetReason = "the memory budget leaves it a coarser map";
    }
    casting.push_back(std::move(of));
  }
  lights = std::move(casting);
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
  report.kernelTexels = numberOf("kernel_size", info, light);
  report.mapSamples = numberOf("map_samples", info, light);
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
  const bool smooths = casting.own->info().has(edgeSettings()) && !casting.light.area;
  return smooths ? static_cast<std::size_t>(casting.light.of<EdgeSettings>().samples) : 1;
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
  LightSet set = this->manager_.collect(renderer, defaults, wishes.casting);
  report.headlightIsAlone = set.headlightIsAlone;
  report.misfits = findMisfits(set.lights, defaults);
  if (renderer->GetLights()->GetNumberOfItems() == 0)
  {
    report.notes.push_back("no light: VTK shades nothing, and nothing casts");
  }
  if (wishes.isShared)
  {
    for (ShadowLight& light : set.lights)
    {
      shareRays(light, report.misfits);
    }
  }

  std::vector<ComposedLight> composed;
  for (ShadowLight& light : set.lights)
  {
    ComposedLight& of = composed.emplace_back();
    of.asked = isAutomatic(light) ? std::optional(light) : std::nullopt;
    of.estimator = &composeIn(light, wishes, report.misfits);
    of.light = std::move(light);
  }
  if (wishes.memoryBudget > 0.0 && !wishes.isShared) // what each process sees differs
  {
    keepBudget(composed, renderer, wishes, set.skipped, report);
  }
  for (ComposedLight& of : composed)
  {
    settle(of.light, of.estimator->info, report.notes);
    report.lights.push_back(reportOfCasting(of.light, of.estimator->info));
    report.lights.back().budgetReason = of.budgetReason;
  }
  std::transform(
    set.skipped.begin(), set.skipped.end(), std::back_inserter(report.lights), reportOfSkipped);
  std::sort(report.lights.begin(), report.lights.end(),
    [](const LightReport& a, const LightReport& b) { return a.sceneIndex < b.sceneIndex; });

  this->ofView_ = &ofView;
  this->lights_.clear();
  for (ComposedLight& of : composed)
  {
    CastingLight& casting = this->lights_.emplace_back();
    casting.own = &this->cacheOf(of.light).of(of.light.sceneIndex, *of.estimator);
    casting.identity = identityOf(of.light);
    casting.channels = channelsOf(of.estimator->info, of.light);
    casting.light = std::move(of.light);
    casting.asked = std::move(of.asked);
    casting.mostMapTexels = of.mostMapTexels;
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
  const auto isHard = [](const CastingLight& casting)
  {
    return isOnCpu(casting) && casting.own->info().exact && !casting.light.area &&
      !casting.light.texture && edgeSamplesOf(casting) == 1;
  };
  this->layers_ = 0;
  this->bits_ = 0;
  for (CastingLight& casting : this->lights_)
  {
    casting.layer = 0;
    casting.bit = noBit;
    if (isHard(casting) && this->bits_ < VisibilityLayers::mostBits)
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
std::string CastingLights::takeMap(CastingLight& casting, int mapSizeTexels, FrameReport& report)
{
  ShadowLight light = *casting.asked;
  light.technique = plainTechnique;
  light.mapSizeTexels = mapSizeTexels;
  return this->takeOther(casting, std::move(light), report);
}

//------------------------------------------------------------------------------
std::string CastingLights::takeCentre(CastingLight& casting, FrameReport& report)
{
  ShadowLight light = *casting.asked;
  light.area.reset();
  return this->takeOther(casting, std::move(light), report);
}

//------------------------------------------------------------------------------
/// Shade a light in this frame as if it were another one.
/// @return why this is impossible, as a clause; empty on success
std::string CastingLights::takeOther(CastingLight& casting, ShadowLight other, FrameReport& report)
{
  const EstimatorEntry* estimator = nullptr;
  try
  {
    estimator = &composeHere(other);
  }
  catch (const CompositionError& error)
  {
    return error.what();
  }
  if (!casting.resting)
  {
    casting.resting.emplace(CastingLight::Resting{ std::move(casting.light), casting.own });
  }
  casting.own = &this->cacheOf(other).of(other.sceneIndex, *estimator);
  casting.light = std::move(other);
  this->tell(casting, report);
  return {};
}

//------------------------------------------------------------------------------
void CastingLights::takeResting(CastingLight& casting, FrameReport& report)
{
  if (!casting.resting)
  {
    return;
  }
  casting.own = casting.resting->technique;
  casting.light = std::move(casting.resting->light);
  casting.resting.reset();
  this->tell(casting, report);
}

//------------------------------------------------------------------------------
/// Note that another technique shades a light in this frame.
void CastingLights::tell(CastingLight& casting, FrameReport& report)
{
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
    // The next motion may reuse a map, unless that was made for a larger memory budget.
    if (casting.asked && casting.asked->mapSizeTexels <= casting.mostMapTexels)
    {
      this->cacheOf(casting.light).keep(casting.light.sceneIndex, plain);
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
