// A frame computes nothing again from unchanged inputs.

#include "PassScene.h"

#include "plugin/frame/ValueKey.h"

#include <vtkTextActor.h>

#include <gmock/gmock.h>

#include <string>
#include <vector>

using namespace gnomon::test;

namespace
{

/// A report's counters of computed values.
struct Made
{
  int receivers = 0;
  int visibility = 0;
  std::int64_t rays = 0;
  int bakes = 0;
  int compiles = 0;
  int structures = 0;

  bool operator==(const Made& other) const
  {
    return this->receivers == other.receivers && this->visibility == other.visibility &&
      this->rays == other.rays && this->bakes == other.bakes && this->compiles == other.compiles &&
      this->structures == other.structures;
  }
};

std::ostream& operator<<(std::ostream& stream, const Made& made)
{
  return stream << made.receivers << " receivers drawn, " << made.visibility
                << " lights' visibility, " << made.rays << " rays, " << made.bakes << " bakes, "
                << made.compiles << " compiles, " << made.structures << " structures";
}

std::vector<std::string> allTechniques()
{
  std::vector<std::string> names;
  for (int i = 0; i < vtkGnomonShadowPass::GetNumberOfTechniques(); ++i)
  {
    names.emplace_back(vtkGnomonShadowPass::GetTechniqueName(i));
  }
  return names;
}

/// A sphere over a floor.
class RenderManager : public PassTest
{
protected:
  RenderManager()
  {
    this->scene.addFloor(4.0);
    this->sphere = this->scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
    this->sun = this->scene.addSun({ 1.0, 0.3, -1.5 });
    this->scene.lookFrom({ 0.0, -9.0, 7.0 });
    this->scene.pass->SetSetting("map_size", "128");
    this->scene.pass->SetSetting("light_samples", "4");
    this->scene.pass->SetSetting("light_radius", "2");
    this->scene.pass->SetSetting("mc_rays", "2");
  }

  Made made() const
  {
    const gnomon::FrameReport& report = this->scene.report();
    return { report.receiversDrawn, report.visibilityComputed, report.raysTraced, report.mapBakes,
      report.programCompiles, report.bvhBuilds + report.bvhRefits };
  }
  Made render()
  {
    this->picture = this->scene.render();
    return this->made();
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
  vtkActor* sphere;
  vtkLight* sun;
  Picture picture; ///< the last frame's picture
};

class RenderManagerByTechnique
  : public RenderManager
  , public testing::WithParamInterface<std::string>
{
protected:
  RenderManagerByTechnique() { this->scene.pass->SetTechnique(GetParam().c_str()); }
};

INSTANTIATE_TEST_SUITE_P(Techniques, RenderManagerByTechnique, testing::ValuesIn(allTechniques()),
  [](const auto& technique) { return technique.param; });

} // namespace

//------------------------------------------------------------------------------
TEST_P(RenderManagerByTechnique, aFrameLikeTheLastOneMakesNothing)
{
  this->settle();
  const Picture before = this->picture;
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(this->render(), Made{}) << "frame " << frame;
    EXPECT_EQ(differingPixels(before, this->picture), 0u) << "frame " << frame;
  }
}

//------------------------------------------------------------------------------
TEST_P(RenderManagerByTechnique, visibilityThatIsKeptIsNotComputedAgain)
{
  this->scene.pass->KeepVisibilityOn();
  this->settle();
  const gnomon::VisibilityImages before = this->scene.pass->GetVisibility();
  EXPECT_EQ(this->render(), Made{});
  const gnomon::VisibilityImages& after = this->scene.pass->GetVisibility();
  ASSERT_FALSE(after.visibility.empty());
  EXPECT_EQ(after.visibility, before.visibility);
  EXPECT_EQ(after.positionX, before.positionX);
  // The report's data of the light stay true.
  EXPECT_EQ(this->scene.report().lights.at(0).technique, GetParam());
}

//------------------------------------------------------------------------------
TEST_P(RenderManagerByTechnique, bothEyesKeepTheirOwn)
{
  this->scene.window->StereoCapableWindowOn();
  this->scene.window->SetStereoTypeToAnaglyph();
  this->scene.window->StereoRenderOn();
  this->settle();
  const Picture before = this->picture;
  EXPECT_EQ(this->render(), Made{});
  EXPECT_EQ(differingPixels(before, this->picture), 0u);
}

//------------------------------------------------------------------------------
TEST_P(RenderManagerByTechnique, twoRenderersOfOnePassKeepTheirOwn)
{
  vtkNew<vtkRenderer> other;
  other->AutomaticLightCreationOff();
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->scene.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  other->AddActor(this->sphere);
  other->AddLight(this->sun);
  other->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  other->SetPass(this->scene.pass);
  this->scene.window->AddRenderer(other);
  this->settle();
  const Picture before = this->picture;
  EXPECT_EQ(this->render(), Made{}); // the second renderer's
  EXPECT_EQ(differingPixels(before, this->picture), 0u);
  other->SetPass(nullptr);
}

//------------------------------------------------------------------------------
TEST_P(RenderManagerByTechnique, aLightThatMovedLeavesTheReceivers)
{
  this->settle();
  this->sun->SetPosition(1.0, 2.0, 3.0);
  EXPECT_EQ(this->render().receivers, 0);
  for (const gnomon::ValueReport& value : this->scene.report().values)
  {
    EXPECT_EQ(value.reused, value.name == "receivers");
    const char* const changes = value.name == "maps of light 0" ? "its views" : "the light";
    EXPECT_THAT(value.changes, testing::HasSubstr(value.reused ? "" : changes)) << value.name;
  }
}

//------------------------------------------------------------------------------
TEST_F(RenderManager, oneOfEightLightsThatMovedIsTheOnlyOneComputed)
{
  this->scene.pass->SetTechnique("raytraced");
  std::vector<vtkLight*> lights{ this->sun };
  for (int i = 1; i < 8; ++i)
  {
    lights.push_back(this->scene.addSun({ 0.3 * i - 1.0, 0.5, -1.5 }));
  }
  this->settle();
  lights[5]->SetPosition(2.0, 2.0, 3.0);
  const Made made = this->render();
  EXPECT_EQ(made.receivers, 0);
  EXPECT_EQ(made.visibility, 1);
  EXPECT_GT(made.rays, 0);
  EXPECT_EQ(made.structures, 0);
}

//------------------------------------------------------------------------------
TEST_F(RenderManager, onlyWhatDependsOnAChangeIsMadeAgain)
{
  this->scene.pass->SetTechnique("raytraced");
  vtkNew<vtkTextActor> text;
  text->SetInput("frame 1");
  this->scene.renderer->AddViewProp(text);
  this->settle();
  text->SetInput("frame 2");
  EXPECT_EQ(this->render(), Made{}) << "a text";
  this->sun->SetDiffuseColor(1.0, 0.5, 0.0);
  EXPECT_EQ(this->render(), Made{}) << "a light's colour";
  this->scene.renderer->GetActiveCamera()->Azimuth(10.0);
  const Made made = this->render();
  EXPECT_EQ(made.receivers, 1);
  EXPECT_EQ(made.visibility, 1);
  EXPECT_EQ(made.structures, 0);
  EXPECT_EQ(made.compiles, 0);
  EXPECT_EQ(this->scene.report().values.at(0).changes, "the camera");
}

//------------------------------------------------------------------------------
TEST(ValueKey, NamesWhatChanged)
{
  gnomon::ValueKey key;
  key.add("the camera", 1);
  key.add("the light", 2);
  gnomon::ValueKey other;
  other.add("the camera", 1);
  other.add("the light", 3);
  EXPECT_EQ(key.changesFrom(key), "");
  EXPECT_EQ(other.changesFrom(key), "the light");
  EXPECT_EQ(key.changesFrom(gnomon::ValueKey()), "the camera, the light");
  gnomon::ValueKey ofOtherType;
  ofOtherType.add("the camera", 1.0);
  EXPECT_EQ(ofOtherType.changesFrom(key), "the camera, the light");
}
