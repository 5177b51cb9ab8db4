// A frame computes only values whose inputs changed since the last one.

#include "PassScene.h"

#include "lights/vtkGnomonLightKeys.h"
#include "plugin/plan/BakeBackoff.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>

#include <gmock/gmock.h>

#include <ostream>
#include <utility>

using namespace gnomon::test;

namespace gnomon
{

/// A report's counters, so that a test states all of them at once.
struct Work
{
  int bakes = 0;
  int compiles = 0;
  int builds = 0;
  int refits = 0;
  int extracted = 0;
  int retransformed = 0;

  bool operator==(const Work& other) const
  {
    return this->bakes == other.bakes && this->compiles == other.compiles &&
      this->builds == other.builds && this->refits == other.refits &&
      this->extracted == other.extracted && this->retransformed == other.retransformed;
  }
};

std::ostream& operator<<(std::ostream& stream, const Work& work)
{
  return stream << work.bakes << " bakes, " << work.compiles << " compiles, " << work.builds
                << " builds, " << work.refits << " refits, " << work.extracted << " extracted, "
                << work.retransformed << " retransformed";
}

} // namespace gnomon

using gnomon::Work;

namespace
{

/// A sphere over a floor, drawn several ways.
class Staleness
  : public PassTest
  , public testing::WithParamInterface<Way>
{
protected:
  Staleness()
  {
    this->scene.addFloor(4.0);
    vtkNew<vtkSphereSource> source;
    source->SetCenter(0.0, 0.0, 1.5);
    source->SetThetaResolution(24);
    source->SetPhiResolution(12);
    source->Update();
    this->sphereData->DeepCopy(source->GetOutput());
    this->sphere = this->scene.add(this->sphereData);
    this->sun = this->scene.addSun({ 1.0, 0.3, -1.5 });
    this->scene.lookFrom({ 0.0, -9.0, 7.0 });
    this->scene.choose(GetParam());
  }

  bool traced() const { return std::string(GetParam().technique) == "raytraced"; }
  Work work() const
  {
    const gnomon::FrameReport& report = this->scene.report();
    return { report.mapBakes, report.programCompiles, report.bvhBuilds, report.bvhRefits,
      report.surfacesExtracted, report.surfacesRetransformed };
  }
  Work render()
  {
    this->scene.render();
    return this->work();
  }
  /// Draw the first frames, after which all values are cached.
  void settle()
  {
    this->scene.render();
    this->scene.render();
  }

  PassScene scene{ 200, 150 };
  vtkNew<vtkPolyData> sphereData;
  vtkActor* sphere;
  vtkLight* sun;
};

INSTANTIATE_TEST_SUITE_P(Ways, Staleness, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnImage, Staleness, testing::Values(tracedWay), nameOf);

} // namespace

//------------------------------------------------------------------------------
TEST_P(Staleness, secondFrameOfAStaticSceneDoesNothingAgain)
{
  const Work first = this->render();
  EXPECT_EQ(first.extracted, 2);
  EXPECT_EQ(first.bakes, this->traced() ? 0 : 1);
  EXPECT_GE(first.builds, this->traced() ? 1 : 0);
  EXPECT_GT(first.compiles, 0);
  const Picture picture = readPicture(this->scene.window);
  for (int frame = 2; frame < 5; ++frame)
  {
    EXPECT_EQ(this->render(), Work{}) << "frame " << frame;
    EXPECT_EQ(differingPixels(picture, readPicture(this->scene.window)), 0u) << "frame " << frame;
  }
  this->scene.renderer->GetActiveCamera()->Azimuth(20.0);
  this->scene.renderer->ResetCameraClippingRange();
  EXPECT_EQ(this->render(), Work{}) << "another camera";
  this->scene.window->SetSize(150, 220);
  EXPECT_EQ(this->render(), Work{}) << "another size";
}

//------------------------------------------------------------------------------
TEST_P(Staleness, movedLightBakesItsMapAndNothingElse)
{
  vtkLight* second = this->scene.addSun({ -1.0, 0.2, -1.0 });
  this->settle();
  second->SetPosition(1.5, -0.2, 1.0);
  Work expected;
  expected.bakes = this->traced() ? 0 : 1;
  EXPECT_EQ(this->render(), expected);
  this->sun->SetIntensity(0.7);
  EXPECT_EQ(this->render(), Work{}) << "another intensity casts the same shadow";
}

//------------------------------------------------------------------------------
TEST_P(Staleness, movedPropIsRetransformedAndNothingElse)
{
  this->settle();
  this->sphere->SetPosition(0.5, 0.0, 0.0);
  Work expected;
  expected.bakes = this->traced() ? 0 : 1;
  expected.refits = this->traced() ? 1 : 0;
  expected.retransformed = 1;
  const Work moved = this->render();
  EXPECT_EQ(moved.bakes, expected.bakes);
  EXPECT_EQ(moved.compiles, 0);
  EXPECT_EQ(moved.builds, 0);
  EXPECT_EQ(moved.extracted, 0);
  EXPECT_EQ(moved.retransformed, 1);
  // The floor's structure is reused; the sphere's own and the top-level one are refit.
  EXPECT_GE(moved.refits, expected.refits);
  EXPECT_LE(moved.refits, 2 * expected.refits);
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, verticesEditedInPlaceAreReadAgain)
{
  this->settle();
  vtkPoints* points = this->sphereData->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double point[3];
    points->GetPoint(i, point);
    points->SetPoint(i, point[0] + 0.7, point[1], point[2]);
  }
  points->Modified();
  this->sphereData->Modified();
  const Work edited = this->render();
  EXPECT_EQ(edited.extracted, 1);
  EXPECT_EQ(edited.retransformed, 0);
  EXPECT_EQ(edited.builds, 0);
  EXPECT_GE(edited.refits, this->traced() ? 1 : 0);
  EXPECT_EQ(edited.bakes, this->traced() ? 0 : 1);
  EXPECT_EQ(edited.compiles, 0);
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, anAddedAndARemovedPropLeaveTheOthersAlone)
{
  this->settle();
  vtkActor* box = this->scene.addBox({ 1.5, -1.0, 0.0 }, { 2.0, 1.0, 1.0 });
  const Work added = this->render();
  EXPECT_EQ(added.extracted, 1);
  EXPECT_EQ(added.retransformed, 0);
  EXPECT_EQ(this->render(), Work{});
  this->scene.renderer->RemoveActor(box);
  const Work removed = this->render();
  EXPECT_EQ(removed.extracted, 0);
  EXPECT_EQ(removed.retransformed, 0);
  EXPECT_EQ(removed.compiles, 0);
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, aPropThatStopsCastingIsNotReadAgain)
{
  this->settle();
  vtkGnomonPropKeys::SetCasts(this->sphere, false);
  const Work changed = this->render();
  EXPECT_EQ(changed.extracted, 0);
  EXPECT_EQ(changed.retransformed, 0);
  EXPECT_EQ(changed.bakes, this->traced() ? 0 : 1);
  EXPECT_EQ(changed.compiles, 0);
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, anotherMapSizeBakesOnce)
{
  this->settle();
  this->scene.pass->SetMapSize(512);
  Work expected;
  expected.bakes = this->traced() ? 0 : 1;
  EXPECT_EQ(this->render(), expected);
  const std::string errors = this->takeErrors();
  EXPECT_EQ(errors.empty(), !this->traced()) << errors;
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, anotherColourOfAPropIsNoWorkForShadows)
{
  this->settle();
  this->sphere->GetProperty()->SetColor(1.0, 0.0, 0.0);
  Work expected;
  expected.compiles = 1; // VTK builds that prop's shader again
  EXPECT_EQ(this->render(), expected);
  EXPECT_EQ(this->render(), Work{});
}

//------------------------------------------------------------------------------
TEST_P(Staleness, anotherTechniqueAndBackKeepsTheSnapshot)
{
  this->settle();
  const Picture before = readPicture(this->scene.window);
  this->scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
  this->scene.pass->SetTechnique(this->traced() ? "nsm" : "raytraced");
  const Work other = this->render();
  EXPECT_EQ(other.extracted, 0);
  EXPECT_EQ(other.retransformed, 0);
  EXPECT_EQ(this->render(), Work{});
  this->scene.choose(GetParam());
  const Work back = this->render();
  EXPECT_EQ(back.extracted, 0);
  EXPECT_EQ(back.builds, 0);
  EXPECT_EQ(differingPixels(before, readPicture(this->scene.window)), 0u);
}

//------------------------------------------------------------------------------
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
    choose(pass, GetParam());
    this->scene.renderer->SetPass(isNew ? pass.Get() : this->scene.pass.Get());
    const Picture gnomon = this->scene.render();
    const gnomon::FrameReport& report = isNew ? pass->GetReport() : this->scene.report();
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
    this->scene.usePlain();
    EXPECT_EQ(differingPixels(gnomon, this->scene.render()), 0u);
  }
}

//------------------------------------------------------------------------------
/// A light with contradictory settings gets the plain technique, and the others reuse their maps.
TEST_F(PassTest, aLightThatCannotBeServedLeavesTheOthersMapsAsTheyAre)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.addSun({ 1.0, 0.3, -1.5 });
  vtkLight* const second = scene.addSun({ -1.0, 0.3, -1.5 });
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();
  scene.pass->SetTechnique("pcf");
  scene.pass->SetSetting("kernel", "castano");
  const auto render = [&](const char* kernelSize)
  {
    vtkGnomonLightKeys::SetSetting(second, "kernel_size", kernelSize);
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

//------------------------------------------------------------------------------
/// An optional map is baked after frames without a change. Until then all pixels are traced, with
/// the same picture.
TEST(OptionalMaps, areBakedOnceNothingMoves)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  vtkActor* const sphere = scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  vtkLight* const sun = scene.addSun({ 1.0, 0.3, -1.5 });
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  scene.pass->SetTechnique("silhouette");
  scene.pass->SetSetting("bake", "settled");
  // Two cameras take turns: from a camera at rest, no visibility would be computed.
  int frames = 0;
  const auto render = [&]
  {
    scene.lookFrom({ 0.01 * (++frames % 2), -9.0, 7.0 });
    return scene.render();
  };
  std::int64_t all = 0;
  const auto expectTraced = [&]
  {
    Picture picture = render();
    EXPECT_EQ(scene.report().mapBakes, 0);
    // Data of the casters' edges are reused.
    EXPECT_LT(scene.report().bytesMaps, std::size_t(1) << 20);
    EXPECT_NE(scene.report().lights[0].mapReason.find("all is traced"), std::string::npos);
    all = scene.report().lights[0].tracedPixels;
    EXPECT_GT(all, 5000);
    return picture;
  };
  const auto expectMapped = [&](int bakes)
  {
    Picture picture = render();
    EXPECT_EQ(scene.report().mapBakes, bakes);
    // A map has a million texels of several numbers each.
    EXPECT_GT(scene.report().bytesMaps, std::size_t(1) << 24);
    EXPECT_EQ(scene.report().lights[0].mapReason, "");
    EXPECT_LT(scene.report().lights[0].tracedPixels, all / 2);
    return picture;
  };
  // After a change.
  const auto expectMappedAfter = [&](int restingFrames)
  {
    Picture traced = expectTraced();
    Picture other = traced; // the other camera's
    for (int frame = 0; frame < restingFrames; ++frame)
    {
      other = std::exchange(traced, expectTraced());
    }
    EXPECT_EQ(differingPixels(other, expectMapped(1)), 0u);
  };
  expectMappedAfter(gnomon::BakeBackoff::leastPatience);
  expectMapped(0);
  for (int frame = 0; frame < 3; ++frame)
  {
    sun->SetPosition(1.0 + frame, 2.0, 5.0);
    expectTraced();
  }
  sphere->AddPosition(0.1, 0.0, 0.0);
  expectMappedAfter(2 * gnomon::BakeBackoff::leastPatience);
  scene.pass->SetSetting("bake", "always");
  sun->SetPosition(3.0, 3.0, 5.0);
  expectMapped(1);
  // The existing map is used, and earlier stale maps do not count for the backoff.
  scene.pass->SetSetting("bake", "settled");
  expectMapped(0);
}

//------------------------------------------------------------------------------
/// A moving picture would stand still while an optional map is baked. `auto` uses an earlier one,
/// and bakes one in the first frame at rest.
TEST(OptionalMaps, areNotBakedByAutoWhileThePictureMoves)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  vtkLight* const sun = scene.addSun({ 1.0, 0.3, -1.5 });
  scene.pass->SetTechnique("auto");
  scene.pass->SetMaximumError(1e-5); // no probe shows it: rays
  scene.pass->SetSetting("bake", "settled");
  int bakes = 0;
  const auto draw = [&](int wish, int frames)
  {
    scene.pass->SetInteractive(wish);
    bakes = 0;
    for (int frame = 0; frame < frames; ++frame)
    {
      scene.lookFrom({ 0.01 * (frame % 2), -9.0, 7.0 });
      scene.render();
      bakes += scene.report().mapBakes;
    }
    return scene.report().lights[0].mapReason;
  };
  const auto move = [&]
  { return draw(vtkGnomonShadowPass::INTERACTIVE_ON, 3 * gnomon::BakeBackoff::leastPatience); };
  const auto rest = [&] { return draw(vtkGnomonShadowPass::INTERACTIVE_OFF, 1); };
  EXPECT_THAT(move(), testing::HasSubstr("moves"));
  EXPECT_EQ(bakes, 0);
  EXPECT_EQ(rest(), "");
  EXPECT_EQ(bakes, 1);
  EXPECT_EQ(move(), "");
  EXPECT_EQ(bakes, 0);
  sun->SetPosition(3.0, 3.0, 5.0);
  EXPECT_THAT(move(), testing::HasSubstr("moves"));
  EXPECT_EQ(bakes, 0);
}

//------------------------------------------------------------------------------
/// Views fitted once stay at their first camera, also before a map is baked.
TEST(OptionalMaps, thatAreFittedOnceNeedNoCameraThatRests)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.addSun({ 1.0, 0.3, -1.5 });
  scene.pass->SetTechnique("silhouette");
  scene.pass->SetSetting("bake", "settled");
  scene.pass->SetSetting("fit", "once");
  const int awaited = gnomon::BakeBackoff::leastPatience;
  for (int frame = 0; frame < awaited + 4; ++frame)
  {
    scene.lookFrom({ 0.1 * frame, -9.0, 7.0 });
    scene.render();
    EXPECT_EQ(scene.report().mapBakes, frame == awaited + 1 ? 1 : 0) << frame;
  }
  scene.pass->SetSetting("fit", "frame");
  for (int frame = 0; frame < 2 * awaited + 4; ++frame)
  {
    scene.lookFrom({ 0.1 * frame, -9.0, 7.0 });
    scene.render();
    EXPECT_EQ(scene.report().mapBakes, 0) << frame;
  }
}

//------------------------------------------------------------------------------
/// Translucent surfaces show a plain map, which does not depend on the exact map's backoff. It is
/// baked at once, with the view of its first fit.
TEST(OptionalMaps, leaveThePlainMapBesideThemAsItIs)
{
  constexpr int mapSize = 64; // so coarse that pictures depend on the view's place
  struct Shown : PassScene
  {
    explicit Shown(const char* technique)
      : PassScene(200, 150)
    {
      this->addFloor(40.0);
      this->addFloor(1.5, 0.4)->GetProperty()->SetOpacity(0.6);
      this->sphere = this->addSphere({ 0.0, 0.0, 1.5 }, 0.5);
      this->addSun({ 1.0, 0.3, -1.5 });
      this->pass->SetTechnique(technique);
      this->pass->SetSetting("bake", "settled");
      this->pass->SetSetting("fit", "once");
      this->pass->SetMapSize(mapSize);
    }
    Picture renderFrom(double x)
    {
      this->lookFrom({ x, -4.0, 4.0 });
      return this->render();
    }
    vtkActor* sphere;
  };
  for (const char* technique : { "crsm", "silhouette" })
  {
    SCOPED_TRACE(technique);
    Shown scene(technique);
    Shown rays("raytraced"); // has only the plain map
    const auto expectBakes = [&](double x, int bakes, int bakesOfRays)
    {
      const Picture shown = scene.renderFrom(x);
      EXPECT_EQ(differingPixels(shown, rays.renderFrom(x)), 0u) << x;
      EXPECT_EQ(scene.report().mapBakes, bakes) << x;
      EXPECT_EQ(rays.report().mapBakes, bakesOfRays) << x;
      return shown;
    };
    expectBakes(0.0, 1, 1); // the plain map
    EXPECT_NE(scene.report().lights[0].mapReason, "");
    for (int frame = 0; frame < gnomon::BakeBackoff::leastPatience; ++frame)
    {
      scene.renderFrom(frame % 2 ? 0.31 : 0.3); // another picture in each frame
      EXPECT_EQ(scene.report().mapBakes, 0) << frame;
    }
    expectBakes(0.3, 1, 0); // the exact one
    EXPECT_EQ(scene.report().lights[0].mapReason, "");
    expectBakes(0.6, 0, 0);
    for (Shown* shown : { &scene, &rays })
    {
      shown->sphere->AddPosition(0.2, 0.1, 0.0);
    }
    expectBakes(0.9, 1, 1); // the plain map again
    EXPECT_NE(scene.report().lights[0].mapReason, "");
    for (int frame = 0; frame < 2 * gnomon::BakeBackoff::leastPatience; ++frame)
    {
      scene.renderFrom(frame % 2 ? 1.21 : 1.2);
      EXPECT_EQ(scene.report().mapBakes, 0) << frame;
    }
    expectBakes(1.2, 1, 0); // the exact one again
    EXPECT_EQ(scene.report().lights[0].mapReason, "");
    const Picture settled = expectBakes(1.5, 0, 0);

    // With another first camera, it has another view.
    Shown fromThere(technique);
    fromThere.sphere->AddPosition(0.2, 0.1, 0.0);
    fromThere.renderFrom(1.5);
    EXPECT_GT(differingPixels(fromThere.renderFrom(1.5), settled), 100u);
    // With that first camera again, it has the same view.
    Shown fromHere(technique);
    fromHere.sphere->AddPosition(0.2, 0.1, 0.0);
    fromHere.renderFrom(0.0);
    EXPECT_EQ(differingPixels(fromHere.renderFrom(1.5), settled), 0u);
  }
}
