// What a frame does, as tables of facts and plans. Nothing here links VTK's rendering or OpenGL.

#include "lights/ShadowSettings.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/PicturePlan.h"

#include <gmock/gmock.h>

#include <functional>
#include <string>
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
  static const EstimatorEntry entry = estimator("raytraced", Evaluation::ScreenCpu, true);
  return entry;
}
const EstimatorEntry& layers()
{
  static const EstimatorEntry entry = estimator("sampled", Evaluation::ScreenGpu, false);
  return entry;
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

SceneLights sceneOf(const std::vector<std::string>& techniques)
{
  SceneLights scene;
  scene.compose = composeOne;
  scene.pixels = 1024 * 1024;
  for (const std::string& technique : techniques)
  {
    ShadowLight light;
    light.technique = technique;
    light.mapSizeTexels = 1024;
    light.sceneIndex = static_cast<int>(scene.set.lights.size());
    scene.set.lights.push_back(light);
  }
  return scene;
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
  std::function<void(SceneLights&, FrameWishes&)> change;
  std::vector<std::string> planned;
  const char* said; ///< part of a misfit, a note, a reason; empty: nothing is said
};

} // namespace

//------------------------------------------------------------------------------
TEST(Plan, givesLightsTheirTechniques)
{
  const auto nothing = [](SceneLights&, FrameWishes&) {};
  const auto shared = [](SceneLights&, FrameWishes& wishes) { wishes.isShared = true; };
  const auto oldGl = [](SceneLights& scene, FrameWishes&) { scene.drawsMaps = false; };
  const auto budget = [](double bytes)
  { return [bytes](SceneLights&, FrameWishes& wishes) { wishes.memoryBudget = bytes; }; };
  const auto keepsImages = [](double bytes)
  {
    return [bytes](SceneLights&, FrameWishes& wishes)
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
    SceneLights scene = sceneOf(of.techniques);
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
      EXPECT_EQ(plan.asked.has_value(), plan.light.technique == "silhouette");
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

//------------------------------------------------------------------------------
TEST(Plan, tracesLightsWithoutRoomForAMap)
{
  SceneLights scene = sceneOf({ "nsm", "nsm" });
  scene.set.lights[1].intensity = 2.0;
  FrameWishes wishes;
  wishes.memoryBudget = 4.1 * mebibyte + 8.0 * 1024 * 1024; // a map, and the image of bits
  const LightPlans plans = planLights(scene, wishes);
  ASSERT_EQ(plans.lights.size(), 2u);
  EXPECT_EQ(plans.lights[0].light.technique, "nsm") << "a coarser map serves";
  EXPECT_LE(plans.lights[0].light.mapSizeTexels, 1024);
  EXPECT_EQ(plans.lights[1].light.mapSizeTexels, 1024) << "the brighter light keeps its map";
}

namespace
{

struct PictureCase
{
  const char* name;
  std::vector<const EstimatorEntry*> lights;
  std::function<void(FrameWishes&, PictureFacts&, PropFacts&)> change;
  Route route;
  const char* reason; ///< part of it
  bool isAsTold = true;
};

} // namespace

//------------------------------------------------------------------------------
TEST(Plan, choosesTheRoute)
{
  using W = FrameWishes;
  using F = PictureFacts;
  using P = PropFacts;
  const auto nothing = [](W&, F&, P&) {};
  const auto wishing = [](RouteWish route)
  { return [route](W& wishes, F&, P&) { wishes.route = route; }; };
  const std::vector<const EstimatorEntry*> nine(9, &compare());
  const std::vector<PictureCase> cases = {
    { "pointwise", { &compare() }, nothing, Route::Inline, "functions of the point" },
    { "no light", {}, nothing, Route::Inline, "" },
    { "slow", { &slow() }, nothing, Route::Image, "takes longer per point" },
    { "slow on samples", { &slow() }, [](W&, F& facts, P&) { facts.samples = 4; }, Route::Inline,
      "functions of the point" },
    { "nine lights", nine, nothing, Route::Image, "at most 8 lights" },
    { "kept", { &compare() }, [](W& wishes, F&, P&) { wishes.keepVisibility = true; }, Route::Image,
      "is kept" },
    { "rays", { &rays() }, nothing, Route::Deferred, "hard and of one light" },
    { "two lights", { &rays(), &rays() }, nothing, Route::Image, "works on the whole screen" },
    { "on the GPU", { &layers() }, nothing, Route::Image, "works on the whole screen" },
    { "samples", { &rays() }, [](W&, F& facts, P&) { facts.samples = 4; }, Route::Image,
      "works on the whole screen" },
    { "processes", { &rays() }, [](W& wishes, F&, P&) { wishes.isShared = true; }, Route::Image,
      "works on the whole screen" },
    { "a pass", { &rays() }, [](W&, F& facts, P&) { facts.drawnPlainly = false; }, Route::Image,
      "works on the whole screen" },
    { "seen through", { &rays() }, [](W&, F& facts, P&) { facts.seenThrough = true; }, Route::Image,
      "works on the whole screen" },
    { "own shaders", { &rays() }, [](W&, F&, P& props) { props.ownShaders = true; }, Route::Image,
      "works on the whole screen" },
    { "parts", { &rays() }, [](W&, F&, P& props) { props.partsOfBothKinds = true; }, Route::Image,
      "works on the whole screen" },
    { "unsupported", { &rays() }, [](W&, F& facts, P&) { facts.whyNoDeferred = "no"; },
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
    ShadowLight light;
    light.technique = "a technique";
    std::vector<PictureLight> lights;
    for (const EstimatorEntry* entry : of.lights)
    {
      lights.push_back({ light, entry->info });
    }
    FrameWishes wishes;
    PictureFacts facts;
    PropFacts props;
    of.change(wishes, facts, props);
    const PicturePlan plan = planPicture(lights, wishes, facts, props);
    EXPECT_EQ(plan.route.route, of.route);
    EXPECT_THAT(plan.route.reason, HasSubstr(of.reason));
    EXPECT_EQ(plan.isAsTold, of.isAsTold);
  }
}

//------------------------------------------------------------------------------
TEST(Plan, notesSamplesOnTheImageRouteAlone)
{
  ShadowLight light;
  light.technique = "a technique";
  FrameWishes wishes;
  PictureFacts facts;
  facts.samples = 4;
  EXPECT_THAT(planPicture({ { light, compare().info } }, wishes, facts, {}).notes, IsEmpty());
  EXPECT_THAT(planPicture({ { light, rays().info } }, wishes, facts, {}).notes,
    Contains(HasSubstr("4 samples per pixel")));
  facts.samples = 1;
  EXPECT_THAT(planPicture({ { light, layers().info } }, wishes, facts, {}).notes, IsEmpty());
}

//------------------------------------------------------------------------------
TEST(Plan, letsTranslucentSurfacesReceive)
{
  ShadowLight light;
  light.technique = "raytraced";
  const std::vector<PictureLight> one = { { light, rays().info } };
  const std::vector<PictureLight> nine(9, one.front());
  FrameWishes wishes;
  PictureFacts facts;
  EXPECT_FALSE(planPicture(one, wishes, facts, {}).shadesTranslucent) << "none receives";
  facts.translucent = true;
  EXPECT_TRUE(planPicture(one, wishes, facts, {}).shadesTranslucent);
  EXPECT_THAT(planPicture(one, wishes, facts, {}).notes, Contains(HasSubstr("plain shadow map")));
  EXPECT_FALSE(planPicture(nine, wishes, facts, {}).shadesTranslucent);
  EXPECT_THAT(planPicture(nine, wishes, facts, {}).notes, Contains(HasSubstr("8 are the most")));
  facts.drawsMaps = false;
  EXPECT_FALSE(planPicture(one, wishes, facts, {}).shadesTranslucent);
  facts.drawsMaps = true;
  wishes.isShared = true;
  EXPECT_FALSE(planPicture(one, wishes, facts, {}).shadesTranslucent);
}

} // namespace gnomon
