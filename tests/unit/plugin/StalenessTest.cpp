// A frame computes only values whose inputs changed since the last one.

#include "PassScene.h"
#include "Variant.h"

#include "plugin/frame/ValueKey.h"
#include "plugin/plan/BakeBackoff.h"

#include <vtkTextActor.h>

namespace gnomon::test
{
namespace
{

/// A report's counters of computed values that are not 0.
using Work = std::map<std::string, std::int64_t>;

Work workOf(const FrameReport& report)
{
  const Work all{ { "extracted", report.surfacesExtracted },
    { "retransformed", report.surfacesRetransformed }, { "builds", report.bvhBuilds },
    { "refits", report.bvhRefits }, { "bakes", report.mapBakes },
    { "compiles", report.programCompiles }, { "receivers", report.receiversDrawn },
    { "visibility", report.visibilityComputed }, { "rays", report.raysTraced } };
  Work work;
  std::copy_if(all.begin(), all.end(), std::inserter(work, work.end()),
    [](const auto& counter) { return counter.second != 0; });
  return work;
}

/// A sphere over a floor.
struct StaleScene : PassTest
{
  StaleScene()
  {
    this->scene.addFloor(4.0);
    this->sphereData = copyOf(ballOf({ 0.0, 0.0, 1.5 }, 0.7, 24, 12));
    this->sphere = this->scene.add(this->sphereData.Get());
    this->sun = this->scene.addSun({ 1.0, 0.3, -1.5 });
    this->scene.lookFrom({ 0.0, -9.0, 7.0 });
  }

  Work render()
  {
    this->picture = this->scene.render();
    return workOf(this->scene.report());
  }
  /// Draw frames until all values are cached.
  void settle()
  {
    this->render();
    for (int frame = 0; frame < 20 && this->scene.pass->GetProgress() < 1.0; ++frame)
    {
      this->render();
    }
    ASSERT_EQ(this->scene.pass->GetProgress(), 1.0);
    constexpr int resting = 4; // after which the deferred route leaves out triangle numbers
    for (int frame = 0; frame < resting; ++frame)
    {
      this->render();
    }
  }

  PassScene scene{ 96, 72 };
  vtkSmartPointer<vtkPolyData> sphereData;
  vtkActor* sphere;
  vtkLight* sun;
  Picture picture; ///< the last frame's picture
};

struct Staleness : PassTestOf<Way, StaleScene>
{
  Staleness()
  {
    this->scene.set("edge_samples", "auto");
    this->scene.choose(GetParam());
  }
  bool traced() const { return std::string(GetParam().technique) == "raytraced"; }
};
INSTANTIATE_TEST_SUITE_P(Ways, Staleness, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnImage, Staleness, testing::Values(tracedWay), nameOf);

/// A change, and the work that its shadows take.
struct Change
{
  const char* what;
  std::function<void()> apply;
  int extracted = 0;
  int retransformed = 0;
  int bakes = 0;  ///< by techniques with a map
  int refits = 0; ///< at least, by those that trace; at most twice as many
  int compiles = 0;
  int receivers = 0;  ///< drawn by those that trace
  int visibility = 0; ///< lights, by those that trace
};

} // namespace

TEST_P(Staleness, aChangeMakesWhatDependsOnIt)
{
  Work first = this->render();
  EXPECT_EQ(first["extracted"], 2);
  EXPECT_EQ(first["bakes"], this->traced() ? 0 : 1);
  EXPECT_GE(first["builds"], this->traced() ? 1 : 0);
  EXPECT_GT(first["compiles"], 0);
  vtkLight* second = this->scene.addSun({ -1.0, 0.2, -1.0 });
  second->SetIntensity(0.5);
  vtkNew<vtkTextActor> text;
  text->SetInput("frame 1");
  this->scene.renderer->AddViewProp(text);
  this->settle();
  const auto editPoints = [this]
  {
    movePoints(
      this->sphereData, [](const glm::dvec3& at) { return at + glm::dvec3(0.7, 0.0, 0.0); });
    this->sphereData->Modified();
  };
  const vtkSmartPointer<vtkActor> box =
    actorOf(mapperOf(boxOf({ 1.5, -1.0, 0.0 }, { 2.0, 1.0, 1.0 })));
  const Change changes[] = {
    { "a camera",
      [&] {
        this->scene.lookFrom({ 2.0, -8.5, 7.0 });
      },
      0, 0, 0, 0, 0, 1, 2 },
    { "a text", [&] { text->SetInput("frame 2"); } },
    { "a size of the window", [&] { this->scene.window->SetSize(70, 90); }, 0, 0, 0, 0, 0, 1, 2 },
    { "an intensity", [&] { this->sun->SetIntensity(0.7); } },
    { "a light's place", [&] { second->SetPosition(1.5, -0.2, 1.0); }, 0, 0, 1, 0, 0, 0, 1 },
    { "a prop's place", [&] { this->sphere->SetPosition(0.5, 0.0, 0.0); }, 0, 1, 2, 1, 0, 1, 2 },
    { "points in place", editPoints, 1, 0, 2, 1, 0, 1, 2 },
    { "a prop less that casts", [&] { vtkGnomonPropKeys::SetCasts(this->sphere, false); }, 0, 0, 2,
      0, 0, 1, 2 },
    { "a prop more that casts", [&] { vtkGnomonPropKeys::SetCasts(this->sphere, true); }, 0, 0, 2,
      0, 0, 1, 2 },
    { "one that casts added", [&] { this->scene.renderer->AddActor(box); }, 1, 0, 2, 0, 1, 1, 2 },
    { "one that casts removed", [&] { this->scene.renderer->RemoveActor(box); }, 0, 0, 2, 0, 0, 1,
      2 },
    { "a colour", [&] { this->sphere->GetProperty()->SetColor(1.0, 0.0, 0.0); }, 0, 0, 0, 0, 1, 1,
      2 },
    { "a map's size", [&] { this->scene.pass->SetMapSize(512); }, 0, 0, 2 },
  };
  for (const Change& change : changes)
  {
    SCOPED_TRACE(change.what);
    change.apply();
    Work work = this->render();
    EXPECT_EQ(work["extracted"], change.extracted);
    EXPECT_EQ(work["retransformed"], change.retransformed);
    EXPECT_EQ(work["bakes"], this->traced() ? 0 : change.bakes);
    EXPECT_EQ(work["compiles"], change.compiles);
    EXPECT_EQ(work["receivers"], this->traced() ? change.receivers : work["receivers"]);
    EXPECT_EQ(work["visibility"], this->traced() ? change.visibility : work["visibility"]);
    EXPECT_EQ(work["rays"] > 0, this->traced() && change.visibility > 0) << work["rays"];
    const bool castersChange = std::string(change.what).find("that casts") != std::string::npos;
    EXPECT_TRUE(work["builds"] == 0 || castersChange);
    EXPECT_GE(work["refits"], this->traced() ? change.refits : 0);
    EXPECT_TRUE(work["refits"] <= 2 * change.refits || castersChange);
    this->render();
    EXPECT_EQ(this->render(), Work{}) << "at rest";
  }
  EXPECT_EQ(this->takeErrors().empty(), !this->traced()) << "there is no map to size";
}

TEST_P(Staleness, anotherTechniqueAndBackKeepsTheSnapshot)
{
  this->settle();
  const Picture before = this->picture;
  this->scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
  this->scene.pass->SetTechnique(this->traced() ? "nsm" : "raytraced");
  Work other = this->render();
  EXPECT_EQ(other["extracted"], 0);
  EXPECT_EQ(other["retransformed"], 0);
  this->scene.choose(GetParam());
  Work back = this->render();
  EXPECT_EQ(back["extracted"], 0);
  EXPECT_EQ(back["builds"], 0);
  EXPECT_EQ(differingPixels(before, this->picture), 0u);
}

/// The picture equals plain VTK's to the byte, and no shadow work is done, also after frames with
/// shadows.
TEST_P(Staleness, withoutACastingLightNothingIsDone)
{
  this->render();
  vtkGnomonLightKeys::SetCasts(this->sun, false);
  for (const bool isNew : { false, true })
  {
    vtkNew<vtkGnomonShadowPass> pass;
    pass->SmoothTerminatorsOff();
    test::choose(pass, GetParam());
    vtkGnomonShadowPass* const by = isNew ? pass : this->scene.pass;
    const Picture gnomon = this->scene.renderBy(by);
    const FrameReport& report = by->GetReport();
    EXPECT_EQ(report.route, "none");
    EXPECT_EQ(report.routeReason, "no light casts a shadow");
    ASSERT_EQ(report.lights.size(), 1u);
    EXPECT_FALSE(report.lights[0].casts);
    EXPECT_EQ(report.lights[0].reason, "marked as not casting");
    EXPECT_EQ(report.mapBakes + report.bvhBuilds + report.surfacesExtracted, 0);
    if (isNew)
    {
      EXPECT_EQ(report.bytesMaps + report.bytesBvh + report.bytesImages, 0u);
      EXPECT_EQ(report.bytesOccluders, 0u);
    }
    EXPECT_EQ(differingPixels(gnomon, this->scene.renderPlain()), 0u);
  }
}

/// A light with contradictory settings gets the plain technique, and the others reuse their maps.
TEST_F(PassTest, aLightThatCannotBeServedLeavesTheOthersMapsAsTheyAre)
{
  SphereUnderSun scene(200, 150);
  vtkLight* const second = scene.addSun({ -1.0, 0.3, -1.5 });
  const Picture plain = scene.renderPlain();
  scene.choose("pcf kernel=castano");
  const auto render = [&](const char* kernelSize)
  {
    set(second, "kernel_size", kernelSize);
    return scene.render();
  };
  const Picture shadowed = render("3");
  EXPECT_EQ(scene.report().mapBakes, 2);

  EXPECT_GT(differingPixels(plain, render("4"), 20), 500u);
  EXPECT_THAT(
    this->takeErrors(), testing::HasSubstr("light 1: the kernel 'castano' has the sizes 3, 5"));
  EXPECT_EQ(scene.report().lights[0].technique, "pcf");
  EXPECT_EQ(scene.report().lights[1].technique, "nsm");
  EXPECT_EQ(scene.report().mapBakes, 1) << "of the light alone";

  EXPECT_EQ(differingPixels(shadowed, render("3")), 0u);
  EXPECT_EQ(scene.report().mapBakes, 1) << "of the light alone";
}

/// Settings of maps bake once; those of lookups bake nothing.
TEST_F(StaleScene, settingsOfMapsBakeOnce)
{
  const std::tuple<const char*, const char*, int> settings[] = {
    { "adaptive", "depth=midpoint", 1 }, { "adaptive", "early_out=ring", 1 },
    { "adaptive", "disc_grid=5", 1 }, { "adaptive", "disc_sets=3", 1 },
    { "adaptive", "bias_constant=0.1", 1 }, { "adaptive", "bias_slope=1", 1 },
    { "adaptive", "metric=euclidean", 1 }, { "adaptive", "kernel_width=0.1", 1 },
    { "pcf", "kernel=poisson", 1 }, { "pcf", "kernel_size=32", 1 }, { "vsm", "bleeding=0.5", 0 },
    { "vsm", "kernel_size=1", 1 }, { "msm", "bleeding=0.4", 0 }, { "msm", "kernel_size=4", 1 },
    { "evsm", "bleeding=0.3", 0 }, { "pssm", "split_lambda=0.9", 1 }, { "nsm", "snap=off", 1 }
  };
  for (const auto& [technique, setting, bakes] : settings)
  {
    SCOPED_TRACE(std::string(technique) + " " + setting);
    this->scene.choose(technique);
    this->scene.set("fit", "frame");
    this->settle();
    const Picture before = this->picture;
    this->scene.choose(setting);
    EXPECT_EQ(this->render()["bakes"], bakes);
    EXPECT_TRUE(bakes == 1 || differingPixels(before, this->picture) > 0);
    Work again = this->render();
    EXPECT_EQ(again["bakes"] + again["compiles"], 0);
    this->scene.set("fit", "off");
  }
}

namespace
{

struct RenderManagerByTechnique : PassTestOf<Variant, StaleScene>
{
  RenderManagerByTechnique()
  {
    this->scene.choose("map_size=128 light_samples=4 light_radius=2 mc_rays=2");
    GetParam().choose(this->scene);
  }
  /// Expect a frame like the last one to compute nothing, and to show the same.
  void expectRest()
  {
    this->settle();
    const Picture before = this->picture;
    for (int frame = 0; frame < 3; ++frame)
    {
      EXPECT_EQ(this->render(), Work{}) << "frame " << frame;
      EXPECT_EQ(differingPixels(before, this->picture), 0u) << "frame " << frame;
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Techniques, RenderManagerByTechnique,
  testing::ValuesIn(variantsThat([](const Variant& variant) { return variant.isDefault(); })),
  testing::PrintToStringParamName());

} // namespace

TEST_P(RenderManagerByTechnique, aFrameLikeTheLastOneMakesNothing)
{
  this->expectRest();
  this->scene.pass->KeepVisibilityOn();
  this->settle();
  const VisibilityImages before = this->scene.pass->GetVisibility();
  EXPECT_EQ(this->render(), Work{});
  const VisibilityImages& after = this->scene.pass->GetVisibility();
  ASSERT_FALSE(after.visibility.empty());
  EXPECT_EQ(after.visibility, before.visibility);
  EXPECT_EQ(after.positionX, before.positionX);
  EXPECT_EQ(this->scene.report().lights.at(0).technique, GetParam().text)
    << "the report stays true";
}

TEST_P(RenderManagerByTechnique, severalViewsKeepTheirOwn)
{
  this->scene.window->StereoCapableWindowOn();
  this->scene.window->SetStereoTypeToAnaglyph();
  this->scene.window->StereoRenderOn();
  this->expectRest();
  this->scene.window->StereoRenderOff();
  vtkNew<vtkRenderer> other;
  other->AutomaticLightCreationOff();
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->scene.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  other->AddActor(this->sphere);
  other->AddLight(this->sun);
  other->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  other->SetPass(this->scene.pass);
  this->scene.window->AddRenderer(other);
  this->expectRest(); // of the second renderer
  other->SetPass(nullptr);
}

TEST_P(RenderManagerByTechnique, aLightThatMovedLeavesTheReceivers)
{
  this->settle();
  this->sun->SetPosition(1.0, 2.0, 3.0);
  EXPECT_EQ(this->render()["receivers"], 0);
  for (const ValueReport& value : this->scene.report().values)
  {
    EXPECT_EQ(value.reused, value.name == "receivers");
    const char* const changes = value.name == "maps of light 0" ? "its views" : "the light";
    EXPECT_THAT(value.changes, testing::HasSubstr(value.reused ? "" : changes)) << value.name;
  }
}

TEST(ValueKey, NamesWhatChanged)
{
  ValueKey key;
  key.add("the camera", 1);
  key.add("the light", 2);
  ValueKey other;
  other.add("the camera", 1);
  other.add("the light", 3);
  EXPECT_EQ(key.changesFrom(key), "");
  EXPECT_EQ(other.changesFrom(key), "the light");
  EXPECT_EQ(key.changesFrom(ValueKey()), "the camera, the light");
  ValueKey ofOtherType;
  ofOtherType.add("the camera", 1.0);
  EXPECT_EQ(ofOtherType.changesFrom(key), "the camera, the light");
}

/// Until an optional map is baked, all pixels are traced, with the same picture. BakeBackoffTest
/// has the order of frames.
TEST(OptionalMaps, areBakedOnceNothingMoves)
{
  SphereUnderSun scene(200, 150);
  scene.choose("silhouette bake=settled");
  std::vector<Picture> pictures;
  // Two cameras take turns: from a camera at rest, no visibility would be computed.
  const auto render = [&](int bakes)
  {
    scene.lookFrom({ 0.01 * (pictures.size() % 2), -9.0, 7.0 });
    pictures.push_back(scene.render());
    EXPECT_EQ(scene.report().mapBakes, bakes);
    return scene.report().lights[0];
  };
  LightReport traced;
  const auto expectTraced = [&](int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      traced = render(0);
      EXPECT_THAT(traced.mapReason, testing::HasSubstr("all is traced"));
      EXPECT_LT(scene.report().bytesMaps, std::size_t(1) << 20); // the casters' edges
    }
  };
  expectTraced(1 + BakeBackoff::leastPatience);
  const LightReport mapped = render(1);
  EXPECT_EQ(mapped.mapReason, "");
  EXPECT_LT(mapped.tracedPixels, traced.tracedPixels / 2);
  EXPECT_GT(scene.report().bytesMaps, std::size_t(1) << 24); // a million texels
  EXPECT_EQ(differingPixels(pictures.back(), pictures[pictures.size() - 3]), 0u);
  render(0);
  scene.sun->SetPosition(1.0, 2.0, 5.0);
  expectTraced(1);
  scene.choose("bake=always");
  render(1);
}

TEST(OptionalMaps, areNotBakedByAutoWhileThePictureMoves)
{
  SphereUnderSun scene(100, 75);
  scene.choose("auto bake=settled");
  scene.pass->SetMaximumError(1e-5); // no probe shows it: rays
  scene.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
  for (int frame = 0; frame < 3 * BakeBackoff::leastPatience; ++frame)
  {
    scene.lookFrom({ 0.01 * (frame % 2), -9.0, 7.0 });
    scene.render();
    EXPECT_THAT(scene.report().lights[0].mapReason, testing::HasSubstr("moves"));
    EXPECT_EQ(scene.report().mapBakes, 0);
  }
  scene.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  scene.lookFrom({ 0.02, -9.0, 7.0 });
  scene.render();
  EXPECT_EQ(scene.report().mapBakes, 1);
}

} // namespace gnomon::test
