// Windows with several samples per pixel, the default of VTK's own windows.

#include "PassScene.h"

#include <vtkConeSource.h>
#include <vtkGlyph3D.h>

using namespace gnomon::test;

namespace
{

constexpr int samples = 8; ///< llvmpipe gives 4

/// Return four flaps around a hollow, each ending where the next begins.
vtkSmartPointer<vtkPolyData> makeHollow()
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 5; ++i)
  {
    points.emplace_back(0.4 * i - 0.8, -0.9, 0.3 * std::abs(i - 2));
    points.emplace_back(0.4 * i - 0.8, 0.9, 0.3 * std::abs(i - 2) + 0.1);
  }
  return meshOf(points, { { 0, 2, 3, 1 }, { 2, 4, 5, 3 }, { 4, 6, 7, 5 }, { 6, 8, 9, 7 } });
}

/// A ball and a hollow above a floor. No box stands on the floor: a pixel's only fragment of the
/// floor may have its centre inside the box.
std::unique_ptr<PassScene> makeSurfaces()
{
  auto scene = std::make_unique<PassScene>(400, 300);
  scene->addFloor(4.0);
  scene->add(ballOf({ 0.0, 0.0, 1.2 }, 1.0, 120, 60));
  vtkActor* hollow = scene->add(makeHollow().Get());
  hollow->RotateZ(25.0);
  hollow->SetPosition(-2.2, 0.0, 0.5);
  scene->addSun({ 1.0, 0.3, -1.5 });
  scene->lookFrom({ 0.3, -7.0, 4.0 }, { -0.7, 0.0, 0.8 });
  vtkCamera* camera = scene->renderer->GetActiveCamera();
  camera->SetParallelScale(2.2);
  camera->ParallelProjectionOn();
  scene->renderer->ResetCameraClippingRange();
  return scene;
}

/// Add a sphere with a spike at each of its points; surfaces intersect.
void addMace(PassScene& scene)
{
  vtkNew<vtkSphereSource> sphere;
  scene.add(sphere);
  vtkNew<vtkConeSource> cone;
  vtkNew<vtkGlyph3D> spikes;
  spikes->SetInputConnection(sphere->GetOutputPort());
  spikes->SetSourceConnection(cone->GetOutputPort());
  spikes->SetVectorModeToUseNormal();
  spikes->SetScaleModeToScaleByVector();
  spikes->SetScaleFactor(0.25);
  scene.add(spikes);
  scene.renderer->ResetCamera();
}

} // namespace

/// Outlines are pixels whose centres show another surface, or none.
TEST_F(PassTest, outlinesAreLitAsTheirSurfaces)
{
  const auto scene = makeSurfaces();
  for (double x = -2.0; x < 2.0; x += 0.11)
  {
    scene->addBox({ x, -1.6, 0.1 }, { x + 0.01, -1.59, 1.0 });
  }
  const double* const along = scene->renderer->GetActiveCamera()->GetDirectionOfProjection();
  scene->renderer->RemoveAllLights();
  scene->addSun({ along[0], along[1], along[2] }); // lights all visible surfaces
  scene->pass->SetTechnique("raytraced");
  scene->window->SetMultiSamples(samples);
  const Picture lit = scene->render();
  EXPECT_EQ(scene->report().route, "image");
  EXPECT_EQ(differingPixels(lit, scene->renderPlain(), 1), 0u);

  scene->addBox({ -20.0, -9.1, -20.0 }, { 20.0, -9.0, 20.0 }); // behind the camera
  const Picture shaded = scene->render();
  EXPECT_EQ(std::count_if(shaded.rgb.begin(), shaded.rgb.end(), [](int v) { return v > 1; }), 0);
}

/// Where two surfaces intersect, each covers pixels whose centres the other one hides.
TEST_F(PassTest, headlightsLeaveLitWhatIsSeenInSeveralSamples)
{
  PassScene scene(300, 300);
  addMace(scene);
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  vtkGnomonLightKeys::SetCasts(headlight, true);
  scene.renderer->AddLight(headlight);
  const auto changedByShadows = [&](const char* technique)
  { return differingPixels(scene.render(technique), scene.renderPlain()); };
  EXPECT_LT(changedByShadows("nsm"), 5u);
  EXPECT_EQ(scene.report().route, "inline");
  scene.window->SetMultiSamples(8);
  for (const char* technique : { "nsm", "crsm" })
  {
    EXPECT_LT(changedByShadows(technique), 5u) << technique;
    EXPECT_EQ(scene.report().route, "image");
  }
  EXPECT_GT(scene.window->GetMultiSamples(), 1);
}

TEST_F(PassTest, theNumberOfSamplesMayChange)
{
  const auto scene = makeSurfaces();
  const Picture single = scene->render();
  scene->window->SetMultiSamples(samples);
  const Picture multiple = scene->render();
  const auto fresh = makeSurfaces();
  fresh->window->SetMultiSamples(samples);
  EXPECT_EQ(differingPixels(multiple, fresh->render()), 0u);
  scene->window->SetMultiSamples(0);
  EXPECT_EQ(differingPixels(scene->render(), single), 0u);
  scene->render();
  EXPECT_EQ(scene->report().programCompiles, 0);
}
