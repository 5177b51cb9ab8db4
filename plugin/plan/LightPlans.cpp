#include "plugin/plan/LightPlans.h"

#include "plugin/plan/MemoryBudget.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the technique of lights that cannot have theirs.
const char* fallbackTechnique(const Scene& scene, const FrameWishes& wishes)
{
  return scene.picture.drawsMaps && !wishes.isShared ? plainTechnique : "raytraced";
}

/// Have a light's rays traced, over several processes.
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

/// Complete a plan's light, as it is or with the fallback technique.
void compose(
  LightPlan& plan, const Scene& scene, const FrameWishes& wishes, std::vector<std::string>& misfits)
{
  Composition composition = scene.lights.compose(std::move(plan.light));
  if (!composition.estimator)
  {
    const char* const fallback = fallbackTechnique(scene, wishes);
    ShadowLight& light = composition.light;
    misfits.push_back(
      nameOf(light) + ": " + composition.refusal + ". It uses '" + fallback + "' instead");
    const int mapSizeTexels = light.mapSizeTexels;
    static_cast<ShadowSettings&>(light) = {};
    light.technique = fallback;
    light.mapSizeTexels = mapSizeTexels;
    composition = scene.lights.compose(std::move(light));
  }
  takeLight(plan, std::move(composition));
}

/// Have a light's rays traced if its technique cannot tell how much light translucent casters let
/// through. Shaders find what volumes leave.
void traceSheets(LightPlan& plan, const Scene& scene, const FrameWishes& wishes, LightPlans& plans)
{
  if (plan.info().evaluation == Evaluation::ScreenCpu ||
    (plan.info().isPointwise() && !scene.props.sheets))
  {
    return;
  }
  plans.notes.push_back(nameOf(plan.light) + ": '" + plan.light.technique +
    "' cannot show how much light translucent casters let through. It uses 'raytraced' instead");
  plan.light.technique = "raytraced";
  plan.light.estimator.clear();
  compose(plan, scene, wishes, plans.misfits);
}

/// Fit the lights to the memory budget.
void keepBudget(LightPlans& plans, const Scene& scene, const FrameWishes& wishes)
{
  std::vector<LightNeed> needs;
  for (const LightPlan& plan : plans.lights)
  {
    LightNeed& need = needs.emplace_back(needOf(plan.light, plan.info(), scene.lights.seenWorld));
    need.isHard = need.isHard && !scene.props.transmits;
    need.channels = scene.props.colours ? 3 : need.channels;
  }
  const bool mayBeInline = (wishes.route == RouteWish::Auto || wishes.route == RouteWish::Inline) &&
    !wishes.keepVisibility;
  const MemoryShares memory =
    shareMemory(needs, wishes.memoryBudget, scene.picture.pixels, mayBeInline);
  const auto automatic = std::count_if(plans.lights.begin(), plans.lights.end(),
    [](const LightPlan& plan) { return plan.asked != nullptr; });

  std::vector<LightPlan> casting;
  for (std::size_t i = 0; i < plans.lights.size(); ++i)
  {
    LightPlan& plan = plans.lights[i];
    const LightShare& share = memory.lights[i];
    if (share.way == LightShare::Way::None)
    {
      plans.skipped.push_back(
        { plan.light.sceneIndex, "the memory budget has no room for an image of its visibility" });
      continue;
    }
    if (plan.asked)
    {
      plan.mostMapTexels = largestMapIn(memory.left / static_cast<double>(automatic), plan.light);
    }
    if (share.way == LightShare::Way::Rays)
    {
      plan.light.mapSizeTexels =
        std::min(plan.light.mapSizeTexels, fewestTexels); // for translucent surfaces
      plan.light.technique = "raytraced";
      plan.light.estimator.clear();
      compose(plan, scene, wishes, plans.misfits);
      plan.budgetReason =
        plan.asked ? "" : "the memory budget has no room for its map, so rays replace it";
    }
    else if (share.mapSizeTexels < plan.light.mapSizeTexels)
    {
      plan.light.mapSizeTexels = share.mapSizeTexels;
      plan.budgetReason = "the memory budget leaves it a coarser map";
    }
    casting.push_back(std::move(plan));
  }
  plans.lights = std::move(casting);
}

/// Reduce a light's settings to OpenGL's limits, and note the effects.
void settle(LightPlan& plan, const SceneLights& scene, std::vector<std::string>& notes)
{
  ShadowLight& light = plan.light;
  int& samples = light.momentMap.samples;
  const int most = std::max(scene.mostMapSamples, 1);
  if (plan.info().has(momentMapSettings()) && samples > most)
  {
    notes.push_back(nameOf(light) + ": OpenGL supports at most " + std::to_string(most) +
      " samples per texel of a map, not " + std::to_string(samples));
    while (samples > most)
    {
      samples /= 2; // a value of `map_samples`
    }
  }
  if (light.texture && !plan.info().seesTextures)
  {
    notes.push_back(nameOf(light) + ": '" + light.technique +
      "' shows an even light of its texture's mean colour");
  }
}

/// Bring the lights into the scene's frame. Those that cannot shine there are skipped.
void enter(LightPlans& plans, const SceneFrame& frame)
{
  const auto isSkipped = [&](LightPlan& plan)
  {
    const std::string reason = enterFrame(plan.light, frame);
    if (!reason.empty())
    {
      plans.skipped.push_back({ plan.light.sceneIndex, reason });
    }
    return !reason.empty();
  };
  plans.lights.erase(
    std::remove_if(plans.lights.begin(), plans.lights.end(), isSkipped), plans.lights.end());
}

/// Return why a light's views cannot be fitted to the drawn receivers; empty if they can.
std::string whyNotReceivers(
  const LightPlan& plan, const MapTraits& traits, Route route, bool points)
{
  const ShadowLight& light = plan.light;
  if (route == Route::Inline)
  {
    return "the inline route does not draw the receivers first";
  }
  if (!plan.info().isPointwise())
  {
    return "the technique works on the screen, so receivers are found after the maps";
  }
  if (light.fit == ViewFit::Off)
  {
    return "it needs the setting fit=frame";
  }
  if (light.projection == Projection::Splits && light.splitBlend > 0.0)
  {
    return "blended splits overlap, but each receiver counts for one split";
  }
  if (light.fit == ViewFit::Once)
  {
    return "a fit made once must also hold later views";
  }
  if (points)
  {
    return "translucent surfaces or volumes receive, but the receivers drawn first are opaque";
  }
  return traits.reachDependsOnViews
    ? "the border of a kernel with a width in world units, or of penumbrae, depends on the fit"
    : "";
}

} // namespace

bool isHard(const TechniqueInfo& info, const ShadowLight& light)
{
  return info.evaluation == Evaluation::ScreenCpu && info.exact && !light.area;
}

std::size_t edgeSamplesOf(const TechniqueInfo& info, const ShadowLight& light)
{
  const bool smooths = info.has(edgeSettings()) && !light.area;
  return smooths ? static_cast<std::size_t>(std::max(light.edge.samples, 1)) : 1;
}

bool smoothsPictures(const TechniqueInfo& info, const ShadowLight& light)
{
  constexpr int automatic = 0; // of `edge_samples`
  return isBit(info, light) && info.has(edgeSettings()) && light.edge.samples == automatic &&
    !light.isPointOfArea; // the mean of many pictures is smooth
}

bool isBit(const TechniqueInfo& info, const ShadowLight& light)
{
  return isHard(info, light) && edgeSamplesOf(info, light) == 1;
}

LightPlans planLights(const Scene& scene, const FrameWishes& wishes)
{
  LightPlans plans;
  plans.skipped = scene.lights.set.skipped;
  plans.misfits = scene.lights.misfits;
  plans.notes = scene.lights.notes;
  auto identity = scene.lights.identities.begin();
  for (const ShadowLight& light : scene.lights.set.lights)
  {
    LightPlan& plan = plans.lights.emplace_back();
    plan.light = light;
    plan.identity = *identity++;
    if (wishes.isShared)
    {
      shareRays(plan.light, plans.misfits);
    }
    plan.asked = isAutomatic(plan.light) ? &light : nullptr;
    compose(plan, scene, wishes, plans.misfits);
    plan.marches = !plan.asked && plan.info().marchesVolumes;
    if (scene.props.transmits)
    {
      traceSheets(plan, scene, wishes, plans);
    }
  }
  if (wishes.isShared && wishes.translucentCasters)
  {
    plans.notes.emplace_back("translucent props cast nothing where several processes draw the "
                             "picture, unless their keys ask; then they block all light");
  }
  if (wishes.isShared && wishes.volumeCasters)
  {
    plans.notes.emplace_back("volumes cast nothing where several processes draw the picture");
  }
  if (wishes.memoryBudget > 0.0 && !wishes.isShared) // what each process sees differs
  {
    keepBudget(plans, scene, wishes);
  }
  for (LightPlan& plan : plans.lights)
  {
    settle(plan, scene.lights, plans.notes);
    plan.resting = plan.estimator;
  }
  enter(plans, scene.props.frame);
  return plans;
}

void takeLight(LightPlan& plan, Composition other)
{
  plan.light = std::move(other.light);
  plan.estimator = other.estimator;
  plan.identity.area = plan.light.area ? plan.identity.area : 0;
}

Composition planAsMap(const ShadowLight& asked, int mapSizeTexels, const Scene& scene)
{
  ShadowLight light = asked;
  light.technique = plainTechnique;
  light.mapSizeTexels = mapSizeTexels;
  enterFrame(light, scene.props.frame);
  return scene.lights.compose(std::move(light));
}

Composition planAsCentre(const ShadowLight& asked, const Scene& scene)
{
  ShadowLight light = asked;
  light.area.reset();
  enterFrame(light, scene.props.frame);
  return scene.lights.compose(std::move(light));
}

ShadedBy planShading(const LightPlan& plan, Route route, bool points)
{
  if (plan.info().isPointwise())
  {
    return points || route == Route::Inline ? ShadedBy::Own : ShadedBy::Fetch;
  }
  return points ? ShadedBy::AtPoints : ShadedBy::Fetch;
}

ShadowLight lightAtPoints(const ShadowLight& light)
{
  ShadowLight atPoints = light;
  atPoints.kernel = {};
  atPoints.pcf = {};
  return atPoints;
}

void planEdges(LightPlan& plan, bool transmits, bool moves, bool mayFollow)
{
  constexpr int samplesAtRest = 16;
  const bool smooths = (transmits || plan.bit != noBit) && smoothsPictures(plan.info(), plan.light);
  plan.edgeSamples = smooths && !moves ? samplesAtRest : 1;
  plan.edgesFollow = mayFollow;
}

void planFit(LightPlan& plan, Route route, bool points, const SceneLights& scene)
{
  if (!plan.info().bakesMap())
  {
    return;
  }
  const MapTraits traits = scene.traitsOf(*plan.estimator, plan.light);
  if (!traits.isFittedToCamera)
  {
    plan.fit = FitTarget::Casters;
    return;
  }
  plan.fitReason = whyNotReceivers(plan, traits, route, points);
  plan.fit = plan.fitReason.empty() ? FitTarget::Receivers : FitTarget::Frustum;
  plan.light.fittedToReceivers = plan.fit == FitTarget::Receivers;
}

} // namespace gnomon
