// `auto`: exact while the picture rests, and while it moves as fast as its error allows.

#include "PassScene.h"

#include "lights/vtkGnomonLightKeys.h"
#include "plugin/frame/CostModel.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

/// Has timers that run when a test says so.
class PatientInteractor : public vtkRenderWindowInteractor
{
public:
  static PatientInteractor* New();
  vtkTypeMacro(PatientInteractor, vtkRenderWindowInteractor);

  int timer = 0;              ///< the one that was started last, 0 once it is gone
  unsigned long patience = 0; ///< milliseconds

  void run()
  {
    int number = this->GetVTKTimerId(this->timer);
    this->InvokeEvent(vtkCommand::TimerEvent, &number);
  }

protected:
  int InternalCreateTimer(int, int, unsigned long duration) override
  {
    this->patience = duration;
    return this->timer = ++this->created_;
  }
  int InternalDestroyTimer(int) override
  {
    this->timer = 0;
    return 1;
  }

private:
  int created_ = 0;
};
vtkStandardNewMacro(PatientInteractor);

/// A box over a floor under the sun, which leaves its technique to the pass.
class Auto
  : public PassTest
  , public PassScene
{
protected:
  Auto()
    : PassScene(160, 120)
  {
    this->pass->SetTechnique("auto");
    this->addFloor(20.0);
    this->addBox(hangingBox.lower, hangingBox.upper);
    this->sun = this->addSun(slantingSun);
    this->lookFrom({ 4.0, -9.0, 7.0 });
  }

  /// A frame of a picture that moves, from another place than the one before.
  Picture move()
  {
    this->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    this->renderer->GetActiveCamera()->Azimuth(1.0);
    return this->render();
  }
  Picture rest()
  {
    this->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_AUTO);
    return this->render();
  }
  std::string technique() const { return this->report().lights[0].technique; }
  /// The picture by another technique.
  Picture by(const char* technique)
  {
    this->pass->SetTechnique(technique);
    const Picture picture = this->render();
    this->pass->SetTechnique("auto");
    return picture;
  }

  vtkLight* sun = nullptr;
};

} // namespace

//------------------------------------------------------------------------------
TEST_F(Auto, isTheDefault)
{
  EXPECT_STREQ(vtkNew<vtkGnomonShadowPass>()->GetTechnique(), "auto");
}

//------------------------------------------------------------------------------
TEST_F(Auto, restingPicturesAreExact)
{
  const Picture first = this->rest();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("rests"));
  EXPECT_TRUE(first == this->by("raytraced"));
}

//------------------------------------------------------------------------------
// Nothing that was drawn while the picture moved is left in it.
TEST_F(Auto, restingPicturesAfterMotionAreThoseOfAFreshPass)
{
  this->rest();
  for (int i = 0; i < 5; ++i)
  {
    this->move();
  }
  ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
  const Picture after = this->rest();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_TRUE(after == this->rest());
  EXPECT_TRUE(after == this->by("raytraced"));
}

//------------------------------------------------------------------------------
TEST_F(Auto, movingPicturesHaveMapsThatAreNotDrawnAgain)
{
  this->pass->SetMapSize(4096);
  this->rest();
  this->move();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
  EXPECT_EQ(this->report().route, "inline");
  EXPECT_GT(this->report().probes, 100);
  std::int64_t probes = 0;
  for (int i = 0; i < 40; ++i)
  {
    this->move();
    EXPECT_EQ(this->report().mapBakes, 0) << i;
    EXPECT_EQ(this->report().bvhBuilds, 0) << i;
    EXPECT_EQ(this->report().programCompiles, 0) << i;
    probes += this->report().probes > 0 ? 1 : 0;
  }
  EXPECT_GE(probes, 2);
  EXPECT_LE(probes, 3);
}

//------------------------------------------------------------------------------
// The map is drawn anew in each frame while the light moves, which takes as long as rays.
TEST_F(Auto, lightsThatMoveTakeRaysAndGoBackToMapsLater)
{
  this->rest();
  this->move();
  ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
  this->sun->SetPosition(-1.0, 0.1, 1.0);
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("nearly as little time"));
  for (int i = 0; i < 29; ++i)
  {
    this->move();
    EXPECT_EQ(this->technique(), "silhouette") << i;
  }
  this->move();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
}

//------------------------------------------------------------------------------
// From the second change on, everything that a change needs is there.
TEST_F(Auto, changesCompileAndDrawNothingAnew)
{
  for (int change = 0; change < 4; ++change)
  {
    for (int frame = 0; frame < 6; ++frame)
    {
      this->rest();
      EXPECT_TRUE(change == 0 || this->report().newPrograms == 0) << change << ", " << frame;
    }
    for (int frame = 0; frame < 3; ++frame)
    {
      this->move();
      ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
      EXPECT_TRUE(change == 0 || this->report().newPrograms == 0) << change << ", " << frame;
      EXPECT_TRUE(change == 0 || this->report().mapBakes == 0) << change << ", " << frame;
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(Auto, mapsGrowUntilTheErrorIsKept)
{
  this->pass->SetMapSize(16);
  this->rest();
  this->move();
  ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
  EXPECT_GE(this->report().lights[0].mapSizeTexels, 64);
  EXPECT_LE(this->report().lights[0].mapSizeTexels, 4096);
}

//------------------------------------------------------------------------------
TEST_F(Auto, raysAreTakenWhereNoMapKeepsTheError)
{
  this->pass->SetMapSize(16);
  this->pass->SetMaximumError(1e-5); // less than one of the probes
  this->rest();
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("are wrong with a map of"));
  this->move();
  EXPECT_THAT(this->report().choice, HasSubstr("a few frames ago"));
  EXPECT_EQ(this->report().probes, 0);
}

//------------------------------------------------------------------------------
TEST_F(Auto, withoutAnErrorAllFramesAreExact)
{
  this->pass->SetMaximumError(0.0);
  this->rest();
  const Picture moving = this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_TRUE(moving == this->by("raytraced"));
}

//------------------------------------------------------------------------------
// The first frame, too, may be one that moves.
TEST_F(Auto, needsNoPictureAtRestBefore)
{
  this->move();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
}

//------------------------------------------------------------------------------
TEST_F(Auto, theSameFramesAreChosenAlike)
{
  const auto run = [this]
  {
    vtkNew<vtkGnomonShadowPass> fresh;
    fresh->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    this->renderer->SetPass(fresh);
    this->lookFrom({ 4.0, -9.0, 7.0 });
    std::string choices;
    for (int i = 0; i < 40; ++i)
    {
      this->renderer->GetActiveCamera()->Azimuth(2.0);
      this->sun->SetPosition(-1.0, i % 13 == 12 ? 0.1 * i : 0.0, 1.0);
      this->window->Render();
      const gnomon::LightReport& light = fresh->GetReport().lights[0];
      choices += light.technique + std::to_string(light.mapSizeTexels) + fresh->GetReport().choice;
    }
    this->useGnomon();
    return choices;
  };
  EXPECT_EQ(run(), run());
}

//------------------------------------------------------------------------------
// Factors of another machine choose another way, for pictures that move alone.
TEST_F(Auto, restingPicturesDoNotDependOnTheMachine)
{
  const Picture expected = this->rest();
  const std::string path =
    (std::filesystem::path(testing::TempDir()) / "gnomon_free_rays.txt").string();
  gnomon::CostFactors factors = gnomon::defaultFactors(true);
  factors.receiverPixel = factors.receiverTriangle = factors.tracePixel = 0.0;
  std::ofstream(path) << gnomon::textOf(factors);
  this->pass->ReadCostFactors(path.c_str());
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  this->renderer->GetActiveCamera()->Azimuth(-1.0);
  EXPECT_TRUE(expected == this->rest());
  EXPECT_TRUE(expected == this->rest());
}

//------------------------------------------------------------------------------
TEST_F(Auto, areaLightsTakeFewerSamplesWhileTheyMove)
{
  this->pass->SetSetting("light_radius", "3");
  const Picture first = this->rest();
  EXPECT_EQ(this->technique(), "penumbra");
  EXPECT_EQ(this->report().lights[0].lightSamples, 64);
  this->move();
  EXPECT_EQ(this->technique(), "penumbra");
  EXPECT_LT(this->report().lights[0].lightSamples, 64) << this->report().choice;
  this->renderer->GetActiveCamera()->Azimuth(-1.0);
  EXPECT_TRUE(first == this->rest());
  EXPECT_EQ(this->report().lights[0].lightSamples, 64);
}

//------------------------------------------------------------------------------
// The error wins over a budget that nothing keeps; rays are taken where there is time.
TEST_F(Auto, aTimeBudgetChoosesWhatIsMostAccurateInIt)
{
  this->pass->SetTimeBudget(1e6);
  this->rest();
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("budget"));
  this->pass->SetTimeBudget(1e-6);
  this->move();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
  this->pass->SetTimeBudget(1e6);
  int frames = 0;
  while (frames < 100 && this->technique() == "nsm")
  {
    this->move();
    ++frames;
  }
  EXPECT_EQ(frames, 30);
}

//------------------------------------------------------------------------------
TEST_F(Auto, framesMoveWhileTheInteractorAsksForMoreThanAtRest)
{
  vtkNew<PatientInteractor> interactor;
  interactor->SetRenderWindow(this->window);
  interactor->Initialize();
  this->rest();
  EXPECT_EQ(this->technique(), "silhouette");
  this->window->SetDesiredUpdateRate(interactor->GetDesiredUpdateRate());
  this->renderer->GetActiveCamera()->Azimuth(1.0);
  this->render();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
  EXPECT_NE(interactor->timer, 0);
  EXPECT_EQ(interactor->patience, 500u);

  // A frame at rest that nobody asked for.
  interactor->run();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_EQ(interactor->timer, 0);

  // One that the interactor asks for.
  this->renderer->GetActiveCamera()->Azimuth(1.0);
  this->render();
  EXPECT_NE(interactor->timer, 0);
  this->window->SetDesiredUpdateRate(interactor->GetStillUpdateRate());
  this->render();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_EQ(interactor->timer, 0);

  this->window->SetDesiredUpdateRate(interactor->GetDesiredUpdateRate());
  this->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  this->render();
  EXPECT_EQ(this->technique(), "silhouette");
  this->window->SetInteractor(nullptr);
}

//------------------------------------------------------------------------------
// Lights that name a technique have it, whatever the pass leaves open.
TEST_F(Auto, lightsThatNameATechniqueKeepIt)
{
  vtkLight* const other = this->addSun({ 0.0, 1.0, -1.0 });
  this->rest();
  vtkGnomonLightKeys::SetSetting(other, "technique", "pcf");
  this->move();
  EXPECT_EQ(this->report().lights[1].technique, "pcf");
  EXPECT_EQ(this->report().lights[0].technique, "nsm") << this->report().choice;
  vtkGnomonLightKeys::SetSetting(other, "technique", "selective");
  this->move();
  EXPECT_EQ(this->report().lights[0].technique, "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("whole screen"));
}
