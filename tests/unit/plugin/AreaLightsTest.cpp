// Area lights in frames: soft with techniques that can, hard with the others.

#include "PassScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "shadowtech/Registry.h"

#include <vtkCollectionRange.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

class AreaLights : public PassTest
{
protected:
  AreaLights()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
    this->scene.addSphere({ 1.3, 0.8, 1.4 }, 0.5);
    this->light->SetPosition(-2.0, -2.5, 6.0);
    this->light->SetFocalPoint(0.0, 0.0, 0.0);
    this->light->SetConeAngle(50.0);
    this->light->SetShapeToRectangle();
    this->scene.renderer->AddLight(this->light);
    this->scene.lookFrom({ 2.0, -8.0, 7.0 });
  }

  std::vector<float> visibility() { return drawKept(this->scene).visibility.at(0); }

  /// Return the pixels that are neither lit nor dark.
  static std::ptrdiff_t between(const std::vector<float>& visibility)
  {
    return std::count_if(
      visibility.begin(), visibility.end(), [](float v) { return v > 0.0f && v < 1.0f; });
  }

  PassScene scene{ 140, 100 };
  vtkNew<vtkGnomonAreaLight> light;
};

//------------------------------------------------------------------------------
TEST_F(AreaLights, areTheirCentreForHardTechniques)
{
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    if (technique.name == "raytraced" || technique.name == "planar" || technique.name == "pcss" ||
      technique.name == "sampled" || technique.name == "montecarlo" ||
      technique.name == "penumbra" || technique.name == "coherence")
    {
      continue;
    }
    this->scene.pass->SetTechnique(technique.name.c_str());
    this->light->SetWidth(3.0);
    const std::vector<float> large = this->visibility();
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 1);
    this->light->SetWidth(0.0);
    this->light->SetHeight(0.0);
    EXPECT_EQ(this->visibility(), large) << technique.name;
    this->light->SetHeight(1.0);
  }
}

//------------------------------------------------------------------------------
TEST_F(AreaLights, haveSmoothEdgesWhereTheirShadowsAreHard)
{
  this->scene.pass->SetTechnique("silhouette");
  this->scene.pass->SetSetting("edge_samples", "4");
  const std::vector<float> smooth = this->visibility();
  EXPECT_GT(between(smooth), 50);
  this->light->SetWidth(0.0);
  this->light->SetHeight(0.0);
  EXPECT_EQ(this->visibility(), smooth);
}

//------------------------------------------------------------------------------
TEST_F(AreaLights, areSoftForThoseThatTakeSamples)
{
  for (const char* technique : { "raytraced", "planar", "sampled", "coherence" })
  {
    this->scene.pass->SetTechnique(technique);
    this->light->SetHeight(1.0);
    this->light->SetWidth(1.0);
    const std::vector<float> soft = this->visibility();
    EXPECT_GT(between(soft), 200);
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 64);
    EXPECT_EQ(this->visibility(), soft) << "the next frame";
    // Each change shows in the next frame.
    this->light->SetWidth(2.0);
    EXPECT_NE(this->visibility(), soft);
    this->light->SetWidth(1.0);
    EXPECT_EQ(this->visibility(), soft);
    this->light->SetShapeToDisk();
    EXPECT_NE(this->visibility(), soft);
    this->light->SetRadius(0.0);
    EXPECT_EQ(between(this->visibility()), 0) << "a point";
    this->light->SetShapeToRectangle();
    this->scene.pass->SetSetting("light_samples", "16");
    EXPECT_NE(this->visibility(), soft);
    this->scene.pass->SetSetting("light_samples", "64");
    this->light->SetRadius(0.5);
  }
}

//------------------------------------------------------------------------------
TEST_F(AreaLights, countTheirRays)
{
  this->scene.pass->SetTechnique("raytraced");
  this->light->SetRadius(0.0);
  this->light->SetShapeToDisk();
  this->visibility();
  const std::int64_t pixels = this->scene.report().lights[0].tracedPixels;
  EXPECT_GT(pixels, 2000);
  this->light->SetShapeToRectangle();
  this->visibility();
  EXPECT_EQ(this->scene.report().lights[0].tracedPixels, pixels);
}

} // namespace

//------------------------------------------------------------------------------
/// Each frame adds four times as many points, until the picture uses all of them.
TEST_F(AreaLights, refineWhileNothingChanges)
{
  for (const char* technique : { "raytraced", "penumbra" })
  {
    SCOPED_TRACE(technique);
    this->scene.pass->SetTechnique(technique);
    this->light->SetWidth(1.0);
    this->scene.pass->SetSetting("light_samples", "100");
    this->scene.pass->SetSetting("moving_samples", "0");
    const std::vector<float> whole = this->visibility();
    EXPECT_EQ(this->scene.pass->GetProgress(), 1.0);
    this->scene.pass->SetSetting("moving_samples", "4");
    const auto expectSteps = [&](std::size_t steps)
    {
      const int samples[] = { 4, 16, 64, 100 };
      double distance = 1.0;
      for (std::size_t step = 0; step < steps; ++step)
      {
        const std::vector<float> seen = this->visibility();
        EXPECT_EQ(this->scene.report().lights[0].lightSamples, samples[step]);
        EXPECT_NEAR(this->scene.pass->GetProgress(), samples[step] / 100.0, 1e-9);
        const double closer = meanVisibilityDifference(seen, whole);
        EXPECT_LT(closer, distance);
        distance = closer;
      }
    };
    expectSteps(4);
    EXPECT_EQ(this->visibility(), whole);
    EXPECT_EQ(this->visibility(), whole) << "at rest";
    EXPECT_EQ(this->scene.report().visibilityComputed, 0);
    this->light->SetWidth(0.9);
    this->visibility();
    this->light->SetWidth(1.0);
    expectSteps(2);
    this->scene.renderer->GetActiveCamera()->Azimuth(1.0);
    this->visibility();
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 4) << "the camera has moved";
    this->scene.renderer->GetActiveCamera()->Azimuth(-1.0);
    expectSteps(4);
    this->scene.pass->SetSetting("light_samples", "3");
    this->visibility();
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 3) << "fewer than the first frame's";
    EXPECT_EQ(this->scene.pass->GetProgress(), 1.0);
    this->light->SetRadius(0.0);
    this->light->SetShapeToDisk();
    this->visibility();
    EXPECT_EQ(this->scene.pass->GetProgress(), 1.0) << "a point";
    this->light->SetShapeToRectangle();
    this->light->SetRadius(0.5);
  }
}

//------------------------------------------------------------------------------
TEST_F(AreaLights, haveAllSamplesAtOnceWhereThePassDrawsSeveralViews)
{
  this->scene.pass->SetTechnique("raytraced");
  this->scene.pass->SetSetting("moving_samples", "4");
  vtkNew<vtkRenderer> other;
  other->SetPass(this->scene.pass);
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->scene.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  other->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  for (vtkActor* actor : vtk::Range(this->scene.renderer->GetActors()))
  {
    other->AddActor(actor);
  }
  other->AddLight(this->light);
  this->scene.window->AddRenderer(other);
  const Picture first = this->scene.render();
  EXPECT_EQ(this->scene.pass->GetProgress(), 1.0);
  EXPECT_EQ(differingPixels(this->scene.render(), first), 0u);
}

//------------------------------------------------------------------------------
TEST_F(AreaLights, refineJitteredSamplesBySquares)
{
  this->scene.pass->SetTechnique("raytraced");
  this->scene.pass->SetSetting("light_sampling", "jittered");
  this->scene.pass->SetSetting("moving_samples", "5");
  this->scene.window->Render();
  EXPECT_THAT(this->takeErrors(), testing::HasSubstr("'moving_samples' 5 is no square"));
  this->scene.pass->SetSetting("moving_samples", "9");
  this->scene.window->Render();
  EXPECT_EQ(this->scene.report().lights[0].lightSamples, 9);
}
