#include "plugin/plan/FramePlan.h"

#include "plugin/plan/MemoryBudget.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon
{
namespace
{

/// Give a light the technique that was chosen for it.
void take(LightPlan& plan, const AutoChoice& choice, const Scene& scene)
{
  if (choice.way == AutoChoice::Way::Resting)
  {
    plan.firstSamples = choice.firstSamples;
    plan.light.lightSamples =
      choice.lightSamples > 0 ? choice.lightSamples : plan.light.lightSamples;
    return;
  }
  takeLight(plan,
    choice.way == AutoChoice::Way::Map ? planAsMap(*plan.asked, choice.mapSizeTexels, scene)
                                       : planAsCentre(*plan.asked, scene));
}

/// Have maps for all lights, of any error, if not even one ray a pixel leaves a moving frame within
/// the time that the window has.
void keepTime(AutoPlan& chosen, const std::vector<LightPlan>& lights, const Scene& scene,
  const FrameWishes& wishes)
{
  const bool fits = std::all_of(chosen.choices.begin(), chosen.choices.end(),
    [&](const AutoChoice& choice)
    {
      return choice.way == AutoChoice::Way::Map ||
        samplesInTime(wishes, chosen.history.times, choice.sceneIndex, lights.size(), 1) == 1;
    });
  if (fits || !scene.picture.moves)
  {
    return;
  }
  std::string why = whyNoInlineMaps(lights, wishes, scene);
  if (std::any_of(lights.begin(), lights.end(),
        [](const LightPlan& light) { return light.mostMapTexels < fewestTexels; }))
  {
    why = "the memory budget has no room for maps";
  }
  if (!why.empty())
  {
    chosen.choice += "; the window's rate is not kept, as " + why;
    return;
  }
  for (AutoChoice& choice : chosen.choices)
  {
    const LightPlan& light = *std::find_if(lights.begin(), lights.end(),
      [&](const LightPlan& of) { return of.light.sceneIndex == choice.sceneIndex; });
    choice.way = AutoChoice::Way::Map;
    choice.mapSizeTexels = std::min(light.asked->mapSizeTexels, light.mostMapTexels);
  }
  chosen.choice = "the picture moves: maps of any error, as rays do not keep the window's rate";
}

/// Choose for lights that leave their technique to the pass. Over several processes all have rays.
void chooseTechniques(FramePlan& plan, const Scene& scene, const FrameWishes& wishes,
  const std::vector<Evidence>& evidence)
{
  const auto isAsked = [](const LightPlan& light) { return light.asked != nullptr; };
  if (wishes.isShared || std::none_of(plan.lights.begin(), plan.lights.end(), isAsked))
  {
    return;
  }
  AutoPlan chosen = planAuto(scene, plan.lights, wishes, plan.history, evidence);
  plan.needs = chosen.needs;
  if (plan.needs)
  {
    return;
  }
  keepTime(chosen, plan.lights, scene, wishes);
  plan.history = std::move(chosen.history);
  plan.choice = std::move(chosen.choice);
  plan.isApproximate = plan.moves;
  for (const AutoChoice& choice : chosen.choices)
  {
    take(*std::find_if(plan.lights.begin(), plan.lights.end(),
           [&](const LightPlan& light) { return light.light.sceneIndex == choice.sceneIndex; }),
      choice, scene);
  }
}

/// Plan with how many samples a light's image begins. Those of several views have all samples at
/// once: the pass's progress is that of the last view alone. So have those of several processes, at
/// rest: nothing draws the next frame.
/// @param inTime samples that leave a moving frame within the time that it has
void planSamples(LightPlan& plan, bool hasAll, int inTime)
{
  const int named = plan.light.refinement.movingSamples;
  const bool refines = !hasAll && plan.info().has(refinementSettings()) && plan.light.area;
  if (!refines || named > 0)
  {
    plan.firstSamples = refines ? named : 0;
  }
  else if (inTime < plan.light.lightSamples)
  {
    const int root = std::max(static_cast<int>(std::sqrt(inTime)), 1);
    plan.firstSamples = root * root; // a square suits all ways to sample
  }
}

/// Plan the sky. Of several views all directions are traced at once: the pass's progress is that of
/// the last view alone. A moving picture has no view of the sky if that does not fit into the time
/// that the window has.
std::optional<SkyPlan> planSky(const Scene& scene, const FrameWishes& wishes,
  const MotionTimes& times, std::vector<std::string>& notes)
{
  const SkyWish& wish = wishes.sky;
  if (!wishes.showsSky())
  {
    if (wish.intensity > 0.0)
    {
      notes.emplace_back("the sky does not shine where several processes draw the picture");
    }
    return std::nullopt;
  }
  SkyPlan plan;
  plan.sky.model = wish.model;
  plan.sky.up = glm::normalize(wish.upWorld);
  if (wish.distanceWorld > 0.0)
  {
    plan.sky.farthest = static_cast<float>(scene.props.frame.unitsPerWorld() * wish.distanceWorld);
  }
  plan.light = static_cast<float>(wish.intensity) * wish.colour;
  plan.directions = wish.directions;
  if (scene.picture.moves)
  {
    plan.rays = skyIsInTime(wishes, times) ? SkyPlan::Rays::Few : SkyPlan::Rays::None;
    if (plan.rays == SkyPlan::Rays::None)
    {
      notes.emplace_back(
        "the sky is not shadowed while the picture moves, to keep the window's rate");
    }
  }
  plan.batchesOfFrame =
    scene.picture.mayRefine && !scene.picture.severalViews ? 1 : SkyDirections::batches;
  return plan;
}

/// True if the picture at rest smooths the edges of any light's shadows.
bool smoothsAny(const FramePlan& plan)
{
  return std::any_of(plan.lights.begin(), plan.lights.end(),
    [](const LightPlan& light) { return smoothsPictures(light.info(), light.light); });
}

/// Assign layers, and bits to lights with hard shadows; one bit more if pictures smooth any of
/// their edges, in motion, too, as the images stay.
void placeVisibility(FramePlan& plan)
{
  const bool smooths = !plan.transmits && smoothsAny(plan);
  const int mostBits = VisibilityLayers::mostBits - (smooths ? 1 : 0);
  for (LightPlan& light : plan.lights)
  {
    light.channels = plan.colours ? 3 : channelsOf(light.info(), light.light);
    if (!plan.transmits && isBit(light.info(), light.light) && plan.bits < mostBits)
    {
      light.bit = plan.bits++;
    }
    else
    {
      light.layer = plan.layers;
      plan.layers += light.channels;
    }
  }
  plan.edgeBit = smooths ? plan.bits++ : noBit;
  if (plan.sky)
  {
    plan.sky->layer = plan.layers++;
  }
}

} // namespace

FramePlan planAtRest(const Scene& scene, const FrameWishes& wishes, const AutoHistory& history)
{
  FramePlan plan;
  LightPlans lights = planLights(scene, wishes);
  plan.lights = std::move(lights.lights);
  plan.skipped = std::move(lights.skipped);
  plan.misfits = std::move(lights.misfits);
  plan.notes = std::move(lights.notes);
  plan.headlightIsAlone = scene.lights.set.headlightIsAlone;
  plan.moves = scene.picture.moves;
  plan.history = history;

  plan.sky = planSky(scene, wishes, history.times, plan.notes);
  const bool takesTime = plan.sky && plan.sky->rays == SkyPlan::Rays::Few;
  plan.history.times.reserved = takesTime ? history.times.sky : 0.0;
  plan.isApproximate = plan.sky && plan.moves;

  plan.transmits = scene.props.transmits;
  plan.colours = scene.props.colours;
  plan.hasShadows = !plan.lights.empty() || plan.sky || wishes.keepVisibility;
  return plan;
}

FramePlan planTechniques(FramePlan plan, const Scene& scene, const FrameWishes& wishes,
  const std::vector<Evidence>& evidence)
{
  chooseTechniques(plan, scene, wishes, evidence);
  plan.needsDeferredFacts =
    plan.hasShadows && !plan.needs && whyNotDeferred(plan.lights, wishes, scene).empty();
  return plan;
}

FramePlan planDrawing(FramePlan plan, const Scene& scene, const FrameWishes& wishes)
{
  if (!plan.hasShadows)
  {
    return plan;
  }
  plan.picture = planPicture(plan.lights, wishes, scene);
  plan.notes.insert(plan.notes.end(), plan.picture.notes.begin(), plan.picture.notes.end());
  for (LightPlan& light : plan.lights)
  {
    const PicturePlan& picture = plan.picture;
    light.shadedBy = planShading(light, picture.route.route, picture.shadesPoints());
    light.surfacesFetch =
      planShading(light, picture.route.route, picture.shadesTranslucent) == ShadedBy::Fetch;
    planFit(light, picture.route.route, picture.shadesPoints(), scene.lights);
    const bool isTimed = plan.moves && (!light.asked || wishes.isShared); // planAuto() has the rest
    const bool hasAll = scene.picture.severalViews || (wishes.isShared && !plan.moves);
    planSamples(light, hasAll,
      isTimed ? samplesInTime(wishes, plan.history.times, light.light.sceneIndex,
                  plan.lights.size(), light.light.lightSamples)
              : light.light.lightSamples);
  }
  placeVisibility(plan);
  plan.isApproximate = plan.isApproximate || (scene.picture.moves && smoothsAny(plan));
  for (LightPlan& light : plan.lights)
  {
    planEdges(light, plan.transmits, scene.picture.moves,
      scene.picture.mayRefine && !scene.picture.severalViews && !wishes.isShared);
  }
  plan.namesSurfaces = wishes.isShared || wishes.keepVisibility;
  // Tiles know nothing of translucent casters that move.
  plan.reusesTiles = !wishes.isShared && !plan.transmits;
  return plan;
}

Numbering numberingOf(const NumberingFacts& facts)
{
  constexpr int patience = 3; // frames
  constexpr std::size_t leastTriangles = 1000;
  if (facts.triangles < leastTriangles * facts.surfaces)
  {
    return Numbering::All;
  }
  if (facts.route == Route::Image && facts.inSoftware)
  {
    return Numbering::Receivers;
  }
  return facts.restingFrames < patience || facts.severalViews ? Numbering::All : Numbering::None;
}

bool storesReceivers(const TracingFacts& facts)
{
  constexpr int patience = 2;     // frames
  constexpr int mostUnstored = 2; // images
  return facts.frames > patience || facts.images > 1 ||
    facts.images + facts.imagesByMaps > mostUnstored;
}

} // namespace gnomon
