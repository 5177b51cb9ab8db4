// The work of a frame, as tables of facts and plans. Nothing here links VTK's rendering or OpenGL.

#include "lights/ShadowSettings.h"
#include "plugin/plan/FramePlan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon
{
namespace
{

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

EstimatorEntry estimator(const char* name, Evaluation evaluation, bool exact)
{
  EstimatorEntry entry;
  entry.info.name = name;
  entry.info.evaluation = evaluation;
  entry.info.exact = exact;
  return entry;
}

const EstimatorEntry& compare()
{
  static const EstimatorEntry entry = []
  {
    EstimatorEntry made = estimator("compare", Evaluation::Pointwise, false);
    made.info.settings.push_back(&viewSettings());
    made.info.bytesPerTexel = [](const ShadowLight&) { return 4.0; };
    return made;
  }();
  return entry;
}
const EstimatorEntry& slow()
{
  static const EstimatorEntry entry = []
  {
    EstimatorEntry made = compare();
    made.info.isSlow = true;
    return made;
  }();
  return entry;
}
const EstimatorEntry& rays()
{
  static const EstimatorEntry entry = []
  {
    EstimatorEntry made = estimator("raytraced", Evaluation::ScreenCpu, true);
    made.info.marchesVolumes = true;
    made.info.settings.push_back(&refinementSettings());
    return made;
  }();
  return entry;
}
const EstimatorEntry& raysWithEdges()
{
  static const EstimatorEntry entry = []
  {
    EstimatorEntry made = rays();
    made.info.settings.push_back(&edgeSettings());
    return made;
  }();
  return entry;
}
const EstimatorEntry& layers()
{
  static const EstimatorEntry entry = estimator("sampled", Evaluation::ScreenGpu, false);
  return entry;
}

LightPlan planOf(const EstimatorEntry& entry)
{
  LightPlan plan;
  plan.light.technique = "a technique";
  plan.estimator = &entry;
  return plan;
}

/// Completes lights of three techniques, and refuses the others.
Composition composeOne(ShadowLight light)
{
  Composition composition{ light, nullptr, "" };
  composition.estimator = light.technique == "nsm"         ? &compare()
    : light.technique == "pcss"                            ? &slow()
    : light.technique == "sampled"                         ? &layers()
    : light.technique == "raytraced" || isAutomatic(light) ? &rays()
                                                           : nullptr;
  composition.refusal = composition.estimator ? "" : "it is unknown";
  if (isAutomatic(light))
  {
    composition.light.technique = "silhouette";
  }
  return composition;
}

Scene sceneOf(const std::vector<std::string>& techniques)
{
  Scene scene;
  scene.lights.compose = composeOne;
  scene.lights.traitsOf = [](const EstimatorEntry&, const ShadowLight& light) {
    return MapTraits{ light.fit != ViewFit::Off, false };
  };
  scene.picture.pixels = 1024 * 1024;
  for (const std::string& technique : techniques)
  {
    ShadowLight light;
    light.technique = technique;
    light.mapSizeTexels = 1024;
    light.sceneIndex = static_cast<int>(scene.lights.set.lights.size());
    scene.lights.set.lights.push_back(light);
    scene.lights.identities.push_back({ 1, 0 });
  }
  return scene;
}

/// Plan a frame until it needs what is not given.
FramePlan planFrame(const Scene& scene, const FrameWishes& wishes, const AutoHistory& history,
  const std::vector<Evidence>& evidence)
{
  FramePlan plan = planTechniques(planAtRest(scene, wishes, history), scene, wishes, evidence);
  const bool isComplete = !plan.needs && (scene.deferred || !plan.needsDeferredFacts);
  return isComplete ? planDrawing(std::move(plan), scene, wishes) : plan;
}

std::vector<std::string> techniquesOf(const LightPlans& plans)
{
  std::vector<std::string> names;
  for (const LightPlan& plan : plans.lights)
  {
    names.push_back(plan.light.technique + " " + std::to_string(plan.light.mapSizeTexels));
  }
  return names;
}

constexpr double mebibyte = 1024.0 * 1024.0;

struct LightCase
{
  const char* name;
  std::vector<std::string> techniques;
  std::function<void(Scene&, FrameWishes&)> change;
  std::vector<std::string> planned;
  const char* said; ///< part of a misfit, a note, a reason; empty: nothing is said
};

TEST(Plan, givesLightsTheirTechniques)
{
  const auto nothing = [](Scene&, FrameWishes&) {};
  const auto shared = [](Scene&, FrameWishes& wishes) { wishes.isShared = true; };
  const auto oldGl = [](Scene& scene, FrameWishes&) { scene.picture.drawsMaps = false; };
  const auto budget = [](double bytes)
  { return [bytes](Scene&, FrameWishes& wishes) { wishes.memoryBudget = bytes; }; };
  const auto keepsImages = [](double bytes)
  {
    return [bytes](Scene&, FrameWishes& wishes)
    {
      wishes.memoryBudget = bytes;
      wishes.keepVisibility = true;
    };
  };
  const std::vector<LightCase> cases = {
    { "as asked", { "nsm", "sampled" }, nothing, { "nsm 1024", "sampled 1024" }, "" },
    { "automatic", { "auto" }, nothing, { "silhouette 1024" }, "" },
    { "refused", { "unknown" }, nothing, { "nsm 1024" }, "light 0: it is unknown" },
    { "refused, old OpenGL", { "unknown" }, oldGl, { "raytraced 1024" }, "'raytraced' instead" },
    { "several processes", { "nsm", "raytraced", "auto" }, shared,
      { "raytraced 1024", "raytraced 1024", "raytraced 1024" }, "the casters of one process" },
    { "a coarser map", { "nsm" }, budget(2.0 * mebibyte), { "nsm 512" }, "a coarser map" },
    { "rays for a map", { "nsm", "nsm" }, budget(16.0 * mebibyte + 0.5), { "nsm 1024", "nsm 1024" },
      "" },
    { "no room", { "nsm" }, keepsImages(mebibyte), {}, "no room for an image" },
  };
  for (const LightCase& of : cases)
  {
    SCOPED_TRACE(of.name);
    Scene scene = sceneOf(of.techniques);
    FrameWishes wishes;
    of.change(scene, wishes);
    const LightPlans plans = planLights(scene, wishes);
    EXPECT_EQ(techniquesOf(plans), of.planned);
    std::vector<std::string> said = plans.misfits;
    said.insert(said.end(), plans.notes.begin(), plans.notes.end());
    for (const SkippedLight& skipped : plans.skipped)
    {
      said.push_back(skipped.reason);
    }
    for (const LightPlan& plan : plans.lights)
    {
      EXPECT_EQ(plan.asked != nullptr, plan.light.technique == "silhouette");
      if (!plan.budgetReason.empty())
      {
        said.push_back(plan.budgetReason);
      }
    }
    if (*of.said)
    {
      EXPECT_THAT(said, Contains(HasSubstr(of.said)));
    }
    else
    {
      EXPECT_THAT(said, IsEmpty());
    }
  }
}

/// Bits of hard shadows share an image; what glass leaves of a light takes a layer, or three.
TEST(Plan, countsTheLayersOfLightsBehindGlass)
{
  Scene scene = sceneOf({ "raytraced", "raytraced" });
  FrameWishes wishes;
  wishes.memoryBudget = (8.0 + 4.1) * mebibyte; // the image of bits, and a layer
  EXPECT_EQ(planLights(scene, wishes).lights.size(), 2u);
  scene.props.transmits = true;
  EXPECT_EQ(planLights(scene, wishes).lights.size(), 1u);
  scene.props.colours = true;
  EXPECT_EQ(planLights(scene, wishes).lights.size(), 0u);
}

/// Shaders read what volumes leave; what glass leaves, rays alone can tell.
TEST(Plan, tracesMapsBehindGlassAndNotBehindVolumes)
{
  Scene scene = sceneOf({ "nsm", "raytraced" });
  scene.props.transmits = true;
  const auto techniques = [&]
  {
    std::vector<std::string> names;
    for (const LightPlan& plan : planLights(scene, {}).lights)
    {
      names.push_back(plan.light.technique + (plan.marches ? " that marches" : ""));
    }
    return names;
  };
  EXPECT_THAT(techniques(), testing::ElementsAre("nsm", "raytraced that marches"));
  scene.props.sheets = true;
  EXPECT_THAT(techniques(), testing::ElementsAre("raytraced", "raytraced that marches"));
}

struct PictureCase
{
  const char* name;
  std::vector<const EstimatorEntry*> lights;
  std::function<void(FrameWishes&, ScenePicture&, Scene&)> change;
  Route route;
  const char* reason; ///< part of it
  bool isAsTold = true;
};

TEST(Plan, choosesTheRoute)
{
  using W = FrameWishes;
  using P = ScenePicture;
  using S = Scene;
  const auto nothing = [](W&, P&, S&) {};
  const auto wishing = [](RouteWish route)
  { return [route](W& wishes, P&, S&) { wishes.route = route; }; };
  const std::vector<const EstimatorEntry*> nine(9, &compare());
  const std::vector<PictureCase> cases = {
    { "pointwise", { &compare() }, nothing, Route::Inline, "functions of the point" },
    { "no light", {}, nothing, Route::Inline, "" },
    { "slow", { &slow() }, nothing, Route::Image, "takes longer per point" },
    { "slow on samples", { &slow() }, [](W&, P& picture, S&) { picture.samples = 4; },
      Route::Inline, "functions of the point" },
    { "nine lights", nine, nothing, Route::Image, "at most 8 lights" },
    { "kept", { &compare() }, [](W& wishes, P&, S&) { wishes.keepVisibility = true; }, Route::Image,
      "is kept" },
    { "rays", { &rays() }, nothing, Route::Deferred, "hard and of one light" },
    { "two lights", { &rays(), &rays() }, nothing, Route::Image, "works on the whole screen" },
    { "on the GPU", { &layers() }, nothing, Route::Image, "works on the whole screen" },
    { "samples", { &rays() }, [](W&, P& picture, S&) { picture.samples = 4; }, Route::Image,
      "works on the whole screen" },
    { "processes", { &rays() }, [](W& wishes, P&, S&) { wishes.isShared = true; }, Route::Image,
      "works on the whole screen" },
    { "a pass", { &rays() }, [](W&, P& picture, S&) { picture.drawnPlainly = false; }, Route::Image,
      "works on the whole screen" },
    { "seen through", { &rays() }, [](W&, P&, S& scene) { scene.props.seenThrough = true; },
      Route::Image, "works on the whole screen" },
    { "own shaders", { &rays() }, [](W&, P&, S& scene) { scene.deferred->ownShaders = true; },
      Route::Image, "works on the whole screen" },
    { "parts", { &rays() }, [](W&, P&, S& scene) { scene.deferred->partsOfBothKinds = true; },
      Route::Image, "works on the whole screen" },
    { "a gamma, no edges", { &rays() },
      [](W&, P&, S& scene) { scene.deferred->physicallyBased = true; }, Route::Deferred,
      "hard and of one light" },
    { "a gamma, edges", { &raysWithEdges() },
      [](W&, P&, S& scene) { scene.deferred->physicallyBased = true; }, Route::Image,
      "works on the whole screen" },
    { "a gamma, edges, in motion", { &raysWithEdges() },
      [](W&, P& picture, S& scene)
      {
        picture.moves = true;
        scene.deferred->physicallyBased = true;
      },
      Route::Deferred, "hard and of one light" },
    { "unsupported", { &rays() }, [](W&, P&, S& scene) { scene.deferred->whyUnsupported = "no"; },
      Route::Image, "works on the whole screen" },
    { "image asked", { &compare() }, wishing(RouteWish::Image), Route::Image, "asked for" },
    { "inline asked", { &rays() }, wishing(RouteWish::Inline), Route::Image,
      "works on the whole screen", false },
    { "deferred asked", { &compare() }, wishing(RouteWish::Deferred), Route::Image,
      "between light and shadow", false },
    { "deferred given", { &rays() }, wishing(RouteWish::Deferred), Route::Deferred, "asked for" },
  };
  for (const PictureCase& of : cases)
  {
    SCOPED_TRACE(of.name);
    std::vector<LightPlan> lights;
    for (const EstimatorEntry* entry : of.lights)
    {
      lights.push_back(planOf(*entry));
    }
    FrameWishes wishes;
    Scene scene;
    scene.deferred = DeferredFacts{};
    of.change(wishes, scene.picture, scene);
    const PicturePlan plan = planPicture(lights, wishes, scene);
    EXPECT_EQ(plan.route.route, of.route);
    EXPECT_THAT(plan.route.reason, HasSubstr(of.reason));
    EXPECT_EQ(plan.isAsTold, of.isAsTold);
  }
}

TEST(Plan, notesSamplesOnTheImageRouteAlone)
{
  FrameWishes wishes;
  Scene scene;
  scene.deferred = DeferredFacts{};
  scene.picture.samples = 4;
  EXPECT_THAT(planPicture({ planOf(compare()) }, wishes, scene).notes, IsEmpty());
  EXPECT_THAT(planPicture({ planOf(rays()) }, wishes, scene).notes,
    Contains(HasSubstr("4 samples per pixel")));
  scene.picture.samples = 1;
  EXPECT_THAT(planPicture({ planOf(layers()) }, wishes, scene).notes, IsEmpty());
}

TEST(Plan, letsTranslucentSurfacesReceive)
{
  const std::vector<LightPlan> one = { planOf(rays()) };
  const std::vector<LightPlan> nine(9, one.front());
  FrameWishes wishes;
  Scene scene;
  scene.deferred = DeferredFacts{};
  EXPECT_FALSE(planPicture(one, wishes, scene).shadesPoints()) << "none receives";
  scene.props.translucent = true;
  EXPECT_TRUE(planPicture(one, wishes, scene).shadesTranslucent);
  EXPECT_FALSE(planPicture(one, wishes, scene).shadesVolumes);
  EXPECT_THAT(planPicture(one, wishes, scene).notes, Contains(HasSubstr("filtered shadow map")));
  scene.props.volumes = true;
  EXPECT_THAT(planPicture(one, wishes, scene).notes,
    Contains(HasSubstr("translucent surfaces and volumes show a filtered shadow map")));
  scene.props.translucent = false;
  EXPECT_FALSE(planPicture(one, wishes, scene).shadesTranslucent);
  EXPECT_TRUE(planPicture(one, wishes, scene).shadesVolumes);
  EXPECT_FALSE(planPicture(nine, wishes, scene).shadesPoints());
  EXPECT_THAT(planPicture(nine, wishes, scene).notes, Contains(HasSubstr("8 are the most")));
  scene.picture.drawsMaps = false;
  EXPECT_FALSE(planPicture(one, wishes, scene).shadesPoints());
  scene.picture.drawsMaps = true;
  wishes.isShared = true;
  EXPECT_FALSE(planPicture(one, wishes, scene).shadesPoints());
}

struct FitCase
{
  const char* name;
  std::function<void(ShadowLight&, MapTraits&)> change;
  Route route;
  FitTarget target;
  const char* reason; ///< part of it
};

TEST(Plan, fitsViews)
{
  using L = ShadowLight;
  using T = MapTraits;
  const auto nothing = [](L&, T&) {};
  const std::vector<FitCase> cases = {
    { "fitted", nothing, Route::Image, FitTarget::Receivers, "" },
    { "inline", nothing, Route::Inline, FitTarget::Frustum, "does not draw the receivers" },
    { "unfitted", [](L&, T& traits) { traits.isFittedToCamera = false; }, Route::Image,
      FitTarget::Casters, "" },
    { "off", [](L& light, T&) { light.fit = ViewFit::Off; }, Route::Image, FitTarget::Frustum,
      "fit=frame" },
    { "once", [](L& light, T&) { light.fit = ViewFit::Once; }, Route::Image, FitTarget::Frustum,
      "later views" },
    { "blended",
      [](L& light, T&)
      {
        light.projection = Projection::Splits;
        light.splitBlend = 0.1;
      },
      Route::Image, FitTarget::Frustum, "overlap" },
    { "reach", [](L&, T& traits) { traits.reachDependsOnViews = true; }, Route::Image,
      FitTarget::Frustum, "depends on the fit" },
  };
  for (const FitCase& of : cases)
  {
    SCOPED_TRACE(of.name);
    LightPlan plan = planOf(compare());
    plan.light.fit = ViewFit::Frame;
    MapTraits traits{ true, false };
    of.change(plan.light, traits);
    SceneLights scene;
    scene.traitsOf = [&](const EstimatorEntry&, const ShadowLight&) { return traits; };
    planFit(plan, of.route, false, scene);
    EXPECT_EQ(plan.fit, of.target);
    EXPECT_THAT(plan.fitReason, HasSubstr(of.reason));
    EXPECT_EQ(plan.light.fittedToReceivers, of.target == FitTarget::Receivers);
  }
  LightPlan mapless = planOf(rays());
  planFit(mapless, Route::Image, false, {});
  EXPECT_EQ(mapless.fit, FitTarget::None);
  LightPlan fitted = planOf(compare());
  SceneLights scene;
  scene.traitsOf = [](const EstimatorEntry&, const ShadowLight&) {
    return MapTraits{ true, false };
  };
  fitted.light.fit = ViewFit::Frame;
  planFit(fitted, Route::Image, true, scene);
  EXPECT_THAT(fitted.fitReason, HasSubstr("translucent"));
}

TEST(Plan, shadesLights)
{
  const std::vector<std::tuple<const EstimatorEntry*, Route, bool, ShadedBy>> cases = {
    { &compare(), Route::Inline, false, ShadedBy::Own },
    { &compare(), Route::Inline, true, ShadedBy::Own },
    { &compare(), Route::Image, false, ShadedBy::Fetch },
    { &compare(), Route::Image, true, ShadedBy::Own },
    { &rays(), Route::Image, false, ShadedBy::Fetch },
    { &rays(), Route::Image, true, ShadedBy::AtPoints },
    { &rays(), Route::Deferred, true, ShadedBy::AtPoints },
  };
  for (const auto& [entry, route, translucent, by] : cases)
  {
    EXPECT_EQ(planShading(planOf(*entry), route, translucent), by)
      << entry->info.name << " " << nameOf(route) << " " << translucent;
  }
}

TEST(FramePlans, leaveOpaqueSurfacesTheirTechniquesWhereTranslucentOnesReceive)
{
  for (const char* technique : { "auto", "raytraced", "sampled", "nsm" })
  {
    Scene scene = sceneOf({ technique });
    scene.deferred = DeferredFacts{};
    const FramePlan without = planFrame(scene, {}, {}, {});
    scene.props.translucent = true;
    const FramePlan with = planFrame(scene, {}, {}, {});
    EXPECT_EQ(with.lights[0].estimator, without.lights[0].estimator) << technique;
    EXPECT_EQ(with.picture.route.route, without.picture.route.route) << technique;
  }
}

TEST(FramePlans, placeVisibility)
{
  Scene scene = sceneOf({ "nsm", "raytraced", "sampled", "raytraced" });
  const FramePlan plan = planFrame(scene, {}, {}, {});
  EXPECT_EQ(plan.layers, 2);
  EXPECT_EQ(plan.bits, 2);
  EXPECT_EQ(plan.lights.at(0).layer, 0);
  EXPECT_EQ(plan.lights.at(1).bit, 0);
  EXPECT_EQ(plan.lights.at(2).layer, 1);
  EXPECT_EQ(plan.lights.at(2).bit, noBit);
  EXPECT_EQ(plan.lights.at(3).bit, 1);
  const FramePlan many = planFrame(sceneOf(std::vector<std::string>(70, "raytraced")), {}, {}, {});
  EXPECT_EQ(many.bits, 64);
  EXPECT_EQ(many.layers, 6);
}

TEST(FramePlans, letTheSkyShine)
{
  FrameWishes wishes;
  wishes.sky.intensity = 0.5;
  wishes.sky.colour = { 1.0f, 0.5f, 0.0f };
  wishes.sky.upWorld = { 0.0, 3.0, 0.0 };
  wishes.sky.distanceWorld = 6.0;
  Scene scene = sceneOf({});
  scene.props.frame.exponent = 1;
  const FramePlan alone = planFrame(scene, wishes, {}, {});
  EXPECT_TRUE(alone.hasShadows);
  EXPECT_EQ(alone.picture.route.route, Route::Image);
  ASSERT_TRUE(alone.sky);
  EXPECT_EQ(alone.layers, 1);
  EXPECT_EQ(alone.sky->layer, 0);
  EXPECT_EQ(alone.sky->light, glm::vec3(0.5f, 0.25f, 0.0f));
  EXPECT_EQ(alone.sky->sky.up, glm::vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(alone.sky->sky.farthest, 3.0f);
  EXPECT_EQ(alone.sky->rays, SkyPlan::Rays::All);
  EXPECT_EQ(alone.sky->batchesOfFrame, SkyDirections::batches);
  EXPECT_FALSE(alone.isApproximate);

  // The sky's layer follows those of the lights. Lights take the image route, too.
  for (const char* technique : { "nsm", "raytraced", "sampled" })
  {
    const FramePlan beside = planFrame(sceneOf({ technique }), wishes, {}, {});
    EXPECT_FALSE(beside.needsDeferredFacts);
    EXPECT_EQ(beside.picture.route.route, Route::Image) << technique;
    EXPECT_EQ(beside.sky->layer, beside.layers - 1) << technique;
  }
  wishes.route = RouteWish::Inline;
  EXPECT_FALSE(planFrame(sceneOf({ "nsm" }), wishes, {}, {}).picture.isAsTold);
  wishes.route = RouteWish::Auto;

  scene.picture.mayRefine = true;
  EXPECT_EQ(planFrame(scene, wishes, {}, {}).sky->batchesOfFrame, 1u);
  scene.picture.severalViews = true;
  EXPECT_EQ(planFrame(scene, wishes, {}, {}).sky->batchesOfFrame, SkyDirections::batches);
  scene.picture.moves = true;
  EXPECT_EQ(planFrame(scene, wishes, {}, {}).sky->rays, SkyPlan::Rays::Few);
  EXPECT_TRUE(planFrame(scene, wishes, {}, {}).isApproximate);

  wishes.isShared = true;
  const FramePlan shared = planFrame(sceneOf({ "raytraced" }), wishes, {}, {});
  EXPECT_FALSE(shared.sky);
  EXPECT_THAT(shared.notes, Contains(HasSubstr("the sky")));
}

TEST(FramePlans, smoothThePicturesEdgesAtRest)
{
  struct EdgeCase
  {
    const char* name;
    std::function<void(Scene&, FrameWishes&)> change;
    int edgeSamples; ///< of light 0
    int bits;        ///< of two lights
    bool follow = false;
  };
  const auto light = [](Scene& scene) -> ShadowLight& { return scene.lights.set.lights[0]; };
  const EdgeCase cases[] = {
    { "at rest", [](Scene&, FrameWishes&) {}, 16, 3 },
    { "in motion", [](Scene& scene, FrameWishes&) { scene.picture.moves = true; }, 1, 3 },
    { "in motion, several processes",
      [](Scene& scene, FrameWishes& wishes) { scene.picture.moves = wishes.isShared = true; }, 1,
      3 },
    { "more frames follow", [](Scene& scene, FrameWishes&) { scene.picture.mayRefine = true; }, 16,
      3, true },
    { "several views",
      [](Scene& scene, FrameWishes&)
      { scene.picture.mayRefine = scene.picture.severalViews = true; },
      16, 3 },
    { "several processes",
      [](Scene& scene, FrameWishes& wishes) { scene.picture.mayRefine = wishes.isShared = true; },
      16, 3 },
    { "named", [&](Scene& scene, FrameWishes&) { light(scene).edge.samples = 16; }, 1, 2 },
    { "switched off", [&](Scene& scene, FrameWishes&) { light(scene).edge.samples = 1; }, 1, 3 },
    { "an area", [&](Scene& scene, FrameWishes&) { light(scene).area.emplace(); }, 1, 2 },
    { "casters that let light through",
      [](Scene& scene, FrameWishes&) { scene.props.transmits = true; }, 16, 0 },
    { "such casters, in motion",
      [](Scene& scene, FrameWishes&) { scene.props.transmits = scene.picture.moves = true; }, 1,
      0 },
    { "a point of one", [&](Scene& scene, FrameWishes&) { light(scene).isPointOfArea = true; }, 1,
      3 },
  };
  for (const EdgeCase& of : cases)
  {
    SCOPED_TRACE(of.name);
    Scene scene = sceneOf({ "raytraced", "raytraced" });
    scene.lights.compose = [](ShadowLight asked) {
      return Composition{ std::move(asked), &raysWithEdges(), "" };
    };
    FrameWishes wishes;
    of.change(scene, wishes);
    const FramePlan plan = planFrame(scene, wishes, {}, {});
    ASSERT_EQ(plan.lights.size(), 2u);
    EXPECT_EQ(plan.lights[0].edgeSamples, of.edgeSamples);
    EXPECT_EQ(plan.lights[0].edgesFollow, of.follow);
    EXPECT_EQ(plan.bits, of.bits);
    EXPECT_EQ(plan.edgeBit, of.bits - 1) << "behind the lights' bits";
    EXPECT_EQ(plan.isApproximate, scene.picture.moves);
  }

  Scene scene = sceneOf({ "raytraced" }); // without the setting
  scene.picture.moves = true;
  scene.deferred = DeferredFacts{};
  EXPECT_EQ(planFrame(scene, {}, {}, {}).edgeBit, noBit);
  EXPECT_FALSE(planFrame(scene, {}, {}, {}).isApproximate);
}

TEST(FramePlans, leaveTheSkyOpenToKeepTheWindowsRate)
{
  FrameWishes wishes;
  wishes.sky.intensity = 0.5;
  wishes.windowTime = 100.0;
  Scene scene = sceneOf({});
  scene.picture.moves = true;
  AutoHistory history;
  const auto rays = [&] { return planFrame(scene, wishes, history, {}).sky->rays; };
  EXPECT_EQ(rays(), SkyPlan::Rays::Few) << "nothing is known yet";
  history.times.restByRays = 40.0;
  history.times.sky = 49.0;
  EXPECT_EQ(rays(), SkyPlan::Rays::Few);
  EXPECT_EQ(planFrame(scene, wishes, history, {}).history.times.reserved, 49.0);
  history.times.sample[3] = 2.0; // of a light
  EXPECT_EQ(rays(), SkyPlan::Rays::None);
  const FramePlan open = planFrame(scene, wishes, history, {});
  EXPECT_THAT(open.notes, Contains(HasSubstr("the sky")));
  EXPECT_EQ(open.history.times.reserved, 0.0);
  EXPECT_TRUE(open.isApproximate);
  for (int frame = 0; frame < 4; ++frame)
  {
    history.times.addSky(0.0);
  }
  EXPECT_EQ(rays(), SkyPlan::Rays::Few) << "tried again";
  history.times.sky = 1000.0;
  wishes.windowTime = 0.0;
  EXPECT_EQ(rays(), SkyPlan::Rays::Few) << "no rate is asked for";
  scene.picture.moves = false;
  wishes.windowTime = 100.0;
  EXPECT_EQ(rays(), SkyPlan::Rays::All);
}

TEST(FramePlans, haveNoShadowsWithoutLights)
{
  FrameWishes wishes;
  EXPECT_FALSE(planFrame(sceneOf({}), wishes, {}, {}).hasShadows);
  wishes.route = RouteWish::Deferred;
  EXPECT_TRUE(planFrame(sceneOf({}), wishes, {}, {}).picture.isAsTold) << "no route is needed";
  wishes.route = RouteWish::Auto;
  EXPECT_TRUE(planFrame(sceneOf({ "nsm" }), wishes, {}, {}).hasShadows);
  wishes.keepVisibility = true;
  EXPECT_TRUE(planFrame(sceneOf({}), wishes, {}, {}).hasShadows) << "receivers are kept";
}

TEST(FramePlans, bringLightsIntoTheScenesFrame)
{
  Scene scene = sceneOf({ "nsm", "nsm" });
  for (ShadowLight& light : scene.lights.set.lights)
  {
    light.kind = LightKind::Point;
  }
  scene.lights.set.lights[0].positionWorld = { 5.0, 0.0, 0.0 };
  scene.lights.set.lights[1].positionWorld = { std::ldexp(1.0, 1020), 0.0, 0.0 };
  scene.props.frame.exponent = 30;
  const FramePlan plan = planFrame(scene, {}, {}, {});
  ASSERT_FALSE(plan.lights.empty());
  EXPECT_EQ(plan.lights[0].light.positionWorld.x, std::ldexp(5.0, -30));
  EXPECT_EQ(plan.lights[0].identity, scene.lights.identities[0]);
  EXPECT_EQ(plan.lights.size() + plan.skipped.size(), 2u);
}

TEST(RayIdentities, differWithAllThatDecidesRays)
{
  const auto changed = [](void (*change)(ShadowLight&))
  {
    ShadowLight light;
    light.box = LightBox{ 1.0, 1.0, 1.0 };
    light.area = ballArea(1.0);
    light.texture.emplace();
    change(light);
    return identityOf(light);
  };
  using L = ShadowLight;
  const RayIdentity before = changed([](L&) {});
  const std::vector<void (*)(L&)> ofCentre = { [](L& l) { l.kind = LightKind::Spot; },
    [](L& l) { l.positionWorld.z = 1.0; }, [](L& l) { l.directionWorld.x = 1.0; },
    [](L& l) { l.coneAngleDegrees = 30.0; }, [](L& l) { l.box.reset(); },
    [](L& l) { l.box->width = 2.0; }, [](L& l) { l.box->height = 2.0; },
    [](L& l) { l.box->depth = 2.0; }, [](L& l) { l.box->upWorld.x = 1.0; },
    [](L& l) { l.texture.reset(); }, [](L& l) { l.texture->pictureFromWorld[0][0] = 3.0f; } };
  for (std::size_t i = 0; i < ofCentre.size(); ++i)
  {
    EXPECT_NE(changed(ofCentre[i]).centre, before.centre) << i;
    EXPECT_EQ(changed(ofCentre[i]).area, before.area) << i;
  }
  for (const auto change : std::vector<void (*)(L&)>{ [](L& l) { l.area = ballArea(2.0); },
         [](L& l) { l.area->shape = LightArea::Shape::Disk; }, [](L& l) { l.area.reset(); } })
  {
    EXPECT_EQ(changed(change).centre, before.centre);
    EXPECT_NE(changed(change).area, before.area);
  }
  EXPECT_EQ(changed([](L& l) { l.intensity = 2.0; }), before) << "no ray depends on it";
}

/// A technique without samples of areas sees the centre alone: it knows nothing of an area's size.
TEST(FramePlans, identifyLightsByWhatTheirTechniquesSee)
{
  for (const bool samples : { true, false })
  {
    Scene scene = sceneOf({ "raytraced" });
    scene.lights.set.lights[0].area.emplace();
    scene.lights.identities[0] = { 1, 2 };
    scene.lights.compose = [&](ShadowLight light)
    {
      light.area = samples ? light.area : std::nullopt;
      return Composition{ std::move(light), &rays(), "" };
    };
    const FramePlan plan = planFrame(scene, {}, {}, {});
    EXPECT_EQ(plan.lights.at(0).identity, (RayIdentity{ 1, samples ? 2u : 0u })) << samples;
  }
}

TEST(FramePlans, ofMotionTakeWhatIsChosen)
{
  Scene scene = sceneOf({ "auto", "nsm" });
  scene.picture.moves = true;
  scene.picture.factors = defaultFactors(true);
  scene.picture.view = 1; // another one than before
  scene.props.casters = { 1, 1 };
  FrameWishes wishes;
  FramePlan plan = planFrame(scene, wishes, {}, {});
  ASSERT_TRUE(plan.needs);
  EXPECT_EQ(plan.lights.at(0).estimator, &rays()) << "the resting technique meanwhile";
  Evidence evidence;
  evidence.probe = { { 30000, 0 }, 8 };
  evidence.isClear = true;
  plan = planFrame(scene, wishes, {}, { evidence });
  ASSERT_FALSE(plan.needs);
  EXPECT_TRUE(plan.moves);
  EXPECT_TRUE(plan.isApproximate);
  EXPECT_EQ(plan.lights.at(0).estimator, &compare());
  EXPECT_EQ(plan.lights.at(0).resting, &rays());
  EXPECT_EQ(plan.lights.at(0).light.mapSizeTexels, 1024);
  EXPECT_EQ(plan.picture.route.route, Route::Inline);
  EXPECT_EQ(plan.history.lights.size(), 2u);

  wishes.isShared = true;
  plan = planFrame(scene, wishes, {}, {});
  EXPECT_FALSE(plan.needs);
  EXPECT_FALSE(plan.isApproximate) << "several processes draw all frames alike";
  EXPECT_TRUE(plan.choice.empty());
}

TEST(FramePlans, ofSeveralProcessesKeepTheBudgetByFewerSamples)
{
  for (const char* const technique : { "raytraced", "auto" })
  {
    SCOPED_TRACE(technique);
    Scene scene = sceneOf({ technique });
    ShadowLight& light = scene.lights.set.lights.front();
    light.area.emplace();
    light.lightSamples = 64;
    AutoHistory history;
    history.times.restByRays = 30.0;
    history.times.sample[light.sceneIndex] = 1.0;
    FrameWishes wishes;
    wishes.isShared = true;
    wishes.timeBudget = 100.0;
    scene.picture.moves = true;
    EXPECT_EQ(planFrame(scene, wishes, history, {}).lights.at(0).firstSamples, 49);
    scene.picture.moves = false;
    EXPECT_EQ(planFrame(scene, wishes, history, {}).lights.at(0).firstSamples, 0) << "all";
    scene.picture.moves = true;
    wishes.timeBudget = 0.0;
    EXPECT_EQ(planFrame(scene, wishes, history, {}).lights.at(0).firstSamples, 0);
    wishes.windowTime = 100.0;
    EXPECT_EQ(planFrame(scene, wishes, history, {}).lights.at(0).firstSamples, 49);
  }
}

TEST(FramePlans, takeMapsOfAnyErrorToKeepTheWindowsRate)
{
  Scene scene = sceneOf({ "auto" });
  scene.picture.moves = true;
  scene.picture.factors = defaultFactors(true);
  FrameWishes wishes;
  wishes.windowTime = 66.0;
  AutoHistory history;
  history.times.restByRays = 40.0;
  const int light = scene.lights.set.lights.at(0).sceneIndex;
  Evidence bad;
  bad.probe = { { 30000, 3000 }, 8 };
  bad.isClear = true;
  const std::vector<Evidence> evidence(8, bad);
  for (const auto& [sample, isKept] : { std::pair(10.0, true), std::pair(30.0, false) })
  {
    history.times.sample[light] = sample;
    const FramePlan plan = planFrame(scene, wishes, history, evidence);
    EXPECT_EQ(plan.lights.at(0).estimator, isKept ? &rays() : &compare()) << plan.choice;
    EXPECT_EQ(plan.choice.find("maps of any error") == std::string::npos, isKept) << plan.choice;
  }
  wishes.keepVisibility = true;
  EXPECT_THAT(planFrame(scene, wishes, history, evidence).choice,
    HasSubstr("the window's rate is not kept, as the visibility is kept"));
  wishes.keepVisibility = false;
  scene.picture.moves = false;
  EXPECT_EQ(planFrame(scene, wishes, history, {}).lights.at(0).estimator, &rays());
}

TEST(MotionTimes, forgetRaysThatAreNotTaken)
{
  FrameWishes wishes;
  wishes.windowTime = 50.0;
  MotionTimes times;
  times.addImage(0, 1.0, 30.0);
  times.add(true, 60.0);
  EXPECT_EQ(limitOf(wishes, times), 50.0);
  EXPECT_EQ(samplesInTime(wishes, times, 0, 1, 1), 0);
  int frames = 0;
  for (; samplesInTime(wishes, times, 0, 1, 1) == 0; ++frames)
  {
    times.add(false, 20.0);
  }
  EXPECT_GT(frames, 30);
  EXPECT_LT(frames, 90);
  times.add(false, 200.0); // VTK itself is slow
  EXPECT_GT(limitOf(wishes, times), 80.0);
}

TEST(FramePlans, numberLargeMeshesWhereImagesTakeNumbers)
{
  const auto onDeferred = [](int restingFrames, bool severalViews, std::size_t triangles) {
    return numberingOf({ Route::Deferred, true, restingFrames, severalViews, triangles, 1 });
  };
  EXPECT_EQ(onDeferred(2, false, 100000), Numbering::All) << "they do not rest long enough";
  EXPECT_EQ(onDeferred(3, false, 100000), Numbering::None);
  EXPECT_EQ(onDeferred(3, false, 1000), Numbering::None);
  EXPECT_EQ(onDeferred(3, false, 999), Numbering::All) << "rebuilt shaders cost more";
  EXPECT_EQ(onDeferred(3, true, 100000), Numbering::All) << "another view may need them";
  const auto onImage = [](bool inSoftware, int restingFrames, std::size_t triangles) {
    return numberingOf({ Route::Image, inSoftware, restingFrames, false, triangles, 2 });
  };
  for (const int restingFrames : { 0, 3 })
  {
    EXPECT_EQ(onImage(true, restingFrames, 2000), Numbering::Receivers);
    EXPECT_EQ(onImage(true, restingFrames, 1999), Numbering::All);
  }
  EXPECT_EQ(onImage(false, 0, 2000), Numbering::All) << "a GPU would wait for rebuilt shaders";
  EXPECT_EQ(onImage(false, 3, 2000), Numbering::None);
}

TEST(FramePlans, storeReceiversForManyImages)
{
  EXPECT_FALSE(storesReceivers({ 1, 1, 1 }));
  EXPECT_FALSE(storesReceivers({ 2, 1, 0 })) << "the camera may move";
  EXPECT_TRUE(storesReceivers({ 3, 1, 0 }));
  EXPECT_TRUE(storesReceivers({ 1, 2, 0 }));
  EXPECT_FALSE(storesReceivers({ 1, 0, 2 })) << "maps spare most receivers";
  EXPECT_TRUE(storesReceivers({ 1, 0, 3 }));
  EXPECT_TRUE(storesReceivers({ 1, 1, 2 }));
}

} // namespace
} // namespace gnomon
