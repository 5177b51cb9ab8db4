// `auto` in motion in built-in scenes with soft shadows, where few probes show an error (thin
// penumbrae) or it is near the limit.

#include "AreaLights.h"
#include "BuiltinPass.h"
#include "Comparison.h"

namespace gnomon::test
{
namespace
{

using MovingSoftScenes = testing::TestWithParam<const char*>;
INSTANTIATE_TEST_SUITE_P(Builtin, MovingSoftScenes,
  testing::Values("soft-plates", "soft-long-cube"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

} // namespace

TEST_P(MovingSoftScenes, keepTheErrorFromAllSides)
{
  const tool::Scene scene = tool::loadScene(GetParam());
  const BuiltinPass shown(scene, 128);
  for (int side = 0; side < 12; ++side)
  {
    shown.renderer->GetActiveCamera()->Azimuth(30.0);
    shown.renderer->ResetCameraClippingRange();
    const VisibilityImages truth = shown.draw("raytraced light_seed=1 light_samples=256");
    shown.draw("auto light_seed=0 light_samples=64"); // at rest
    shown.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    const tool::VisibilityError error = tool::measureError(shown.draw("auto"), truth, scene.lights);
    EXPECT_LE(error.rootMeanSquare, 0.03) << side;
    EXPECT_LT(shown.report().lights[0].lightSamples, 64);
    shown.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_AUTO);
  }
}

} // namespace gnomon::test
