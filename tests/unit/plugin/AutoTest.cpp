// `auto` is exact at rest; in motion it takes the fastest technique within the allowed error.

#include "AreaLights.h"

#include "plugin/plan/CostModel.h"

#include <vtkShaderProperty.h>

#include <filesystem>
#include <fstream>

using namespace gnomon::test;
using testing::HasSubstr;

namespace
{

/// A box over a floor under a sun that uses the pass's technique.
struct Auto
  : PassTest
  , BoxScene
{
  Auto()
    : BoxScene(160, 120)
  {
    this->pass->SetTechnique("auto");
  }

  /// Draw a frame in motion, from another place than the last one.
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
  void readFactors(const gnomon::CostFactors& factors)
  {
    const std::string path =
      (std::filesystem::path(testing::TempDir()) / "gnomon_auto_factors.txt").string();
    std::ofstream(path) << gnomon::textOf(factors);
    this->pass->ReadCostFactors(path.c_str());
  }
  std::string technique() const { return this->report().lights[0].technique; }
  /// Draw the picture by another technique.
  Picture by(const char* technique)
  {
    this->pass->SetTechnique(technique);
    const Picture picture = this->render();
    this->pass->SetTechnique("auto");
    return picture;
  }
};

} // namespace

// A picture at rest shows nothing of the frames in motion.
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

TEST_F(Auto, numbersOutOfRangeAreErrorsAndChangeNothing)
{
  for (const double wrong : { -0.1, 1.1, std::nan("") })
  {
    this->pass->SetMaximumError(wrong);
    EXPECT_THAT(this->takeErrors(), HasSubstr("MaximumError was to be"));
    this->pass->SetMaximumSoftError(wrong);
    EXPECT_THAT(this->takeErrors(), HasSubstr("MaximumSoftError was to be"));
  }
  for (const double wrong : { -0.1, -2.0, std::nan("") })
  {
    this->pass->SetTimeBudget(wrong);
    EXPECT_THAT(this->takeErrors(), HasSubstr("TimeBudget was to be"));
  }
  EXPECT_EQ(this->pass->GetMaximumError(), 0.005);
  EXPECT_EQ(this->pass->GetMaximumSoftError(), 0.03);
  EXPECT_EQ(this->pass->GetTimeBudget(), GNOMON_TIME_BUDGET_OF_WINDOW);
  const vtkMTimeType time = this->pass->GetMTime();
  this->pass->SetTimeBudget(vtkGnomonShadowPass::TIME_BUDGET_OF_WINDOW);
  EXPECT_EQ(this->pass->GetMTime(), time);
}

// Windows with several samples draw a headlight's shadows by the image route, with any technique.
TEST_F(Auto, severalSamplesAndAHeadlight)
{
  gnomon::CostFactors factors = gnomon::defaultFactors(true);
  factors.tracePixel = 1e4; // the headlight's map is baked in each frame
  this->readFactors(factors);
  this->window->SetMultiSamples(4);
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetIntensity(0.5);
  vtkGnomonLightKeys::SetCasts(headlight, true);
  this->renderer->AddLight(headlight);
  this->rest();
  const Picture moving = this->move();
  ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
  EXPECT_EQ(this->report().route, "image");
  const Picture exact = this->by("raytraced");
  EXPECT_LE(differingPixels(moving, exact, 16), exact.pixels() / 100);
}

// An area light without extent only uses its texture's mean.
TEST_F(Auto, texturesWithoutAnAreaAreExact)
{
  addDisk(*this, { -4.0, 0.0, 5.0 }, glm::dvec3(0.0), 0.0, 30.0)
    ->SetTexture(makeImage(2, 2, [](int, int) { return glm::dvec3(0.8); }));
  this->rest();
  const Picture moving = this->move();
  EXPECT_THAT(this->report().choice, HasSubstr("area lights"));
  EXPECT_TRUE(moving == this->rest());
}

TEST_F(Auto, settingsOfWhatItMayTakeAreNoMistakes)
{
  this->set("light_radius", "3");
  this->set("light_samples", "16");
  this->set("bias_constant", "0.001"); // a setting of maps
  this->set("edge_samples", "16");     // and of hard shadows
  this->rest();
  EXPECT_EQ(this->report().lights[0].lightSamples, 16);
  this->set("mc_rays", "4");
  this->render();
  EXPECT_THAT(this->takeErrors(), HasSubstr("mc_rays"));
}

// Probes hit casters where the snapshot has them.
TEST_F(Auto, surfacesThatShaderCodeMovesTakeRays)
{
  vtkActor* const shelf = this->addFloor(2.0, 4.0);
  this->rest();
  this->move();
  EXPECT_EQ(this->technique(), "nsm");
  shelf->GetShaderProperty()->AddVertexShaderReplacement(
    "//VTK::Camera::Impl", true, "//VTK::Camera::Impl\n  gl_Position.x += 0.1;\n", false);
  this->rest();
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_THAT(this->report().choice, HasSubstr("shader code moves it"));
}

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

// Cost factors of another machine change the choice for pictures in motion only.
TEST_F(Auto, restingPicturesDoNotDependOnTheMachine)
{
  const Picture expected = this->rest();
  gnomon::CostFactors factors = gnomon::defaultFactors(true);
  factors.receiverPixel = factors.receiverTriangle = factors.tracePixel = 0.0;
  this->readFactors(factors);
  this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  this->renderer->GetActiveCamera()->Azimuth(-1.0);
  EXPECT_TRUE(expected == this->rest());
  EXPECT_TRUE(expected == this->rest());
}

// Where penumbrae are thin, hard shadows keep the error. At rest they are soft again.
TEST_F(Auto, areaLightsHaveHardShadowsInMotionWherePenumbraeAreThin)
{
  this->set("light_radius", "0.1");
  this->rest();
  const Picture moving = this->move();
  EXPECT_EQ(this->technique(), "silhouette");
  EXPECT_EQ(this->report().raysTraced, this->report().lights[0].tracedPixels) << "one a pixel";
  const Picture soft = this->rest();
  EXPECT_EQ(this->technique(), "penumbra");
  EXPECT_EQ(this->report().lights[0].lightSamples, 64);
  EXPECT_TRUE(soft == this->by("penumbra"));
  EXPECT_TRUE(moving == this->by("silhouette"));
  EXPECT_FALSE(moving == soft);

  this->set("light_radius", "3");
  this->move();
  EXPECT_EQ(this->technique(), "penumbra");
}

// A light that names a technique uses it with any technique of the pass.
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

// A close view makes the map larger; the next motion has a small one again.
TEST_F(Auto, mapsShrinkWhereSmallerOnesWillDo)
{
  this->pass->SetMapSize(16);
  this->rest();
  this->move();
  ASSERT_EQ(this->technique(), "nsm") << this->report().choice;
  const int large = this->report().lights[0].mapSizeTexels;
  this->pass->SetMaximumError(0.2);
  this->move();
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, 16) << "another error is asked for";
  this->pass->SetMaximumError(0.005);
  this->move();
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, large);
  this->lookFrom({ -12.0, -9.0, 7.0 }, { -12.0, 0.0, 0.0 }); // looks far from the shadow
  this->move();
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, large) << "in the same motion";
  this->rest();
  this->move();
  EXPECT_EQ(this->report().lights[0].mapSizeTexels, 16);
}

// A moving light bakes its map in each frame, which costs as much time as rays.
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

// Lights that needed no rays are expected to need none in motion.
TEST_F(Auto, lightsThatReachNothingTakeRays)
{
  this->set("bake", "settled");
  this->renderer->RemoveLight(this->sun);
  vtkLight* const lamp = this->addSpot({ 0.0, 0.0, 4.0 }, { 0.0, 0.0, 9.0 }, 40.0);
  vtkLight* const other = this->addSpot({ 2.0, 0.0, 4.0 }, { 2.0, 0.0, 9.0 }, 40.0);
  this->rest();
  ASSERT_THAT(this->report().lights[0].skipReason, HasSubstr("cone reaches nothing"));
  for (int i = 0; i < 40; ++i)
  {
    this->move();
    EXPECT_EQ(this->technique(), "silhouette") << i;
    EXPECT_THAT(this->report().choice, HasSubstr("nearly as little time")) << i;
  }
  lamp->SetFocalPoint(0.0, 0.0, 0.0);
  other->SetFocalPoint(0.0, 0.0, 0.0);
  this->rest();
  ASSERT_EQ(this->report().lights[0].skipReason, "");
  this->move();
  EXPECT_EQ(this->technique(), "nsm") << this->report().choice;
}
