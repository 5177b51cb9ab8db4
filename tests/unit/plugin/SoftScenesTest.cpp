// Techniques with soft shadows in built-in scenes: bounds of their error against rays.

#include "AreaLights.h"
#include "BuiltinPass.h"
#include "Comparison.h"

namespace gnomon::test
{
namespace
{

struct SoftScene
{
  const char* name;
  const char* sunDegrees = nullptr; ///< null: the scene has a lamp
  double sampledRms = 0.0;          ///< the largest of `sampled` with 256 points
};
std::ostream& operator<<(std::ostream& stream, const SoftScene& scene)
{
  return stream << scene.name;
}
std::string nameOfScene(const testing::TestParamInfo<SoftScene>& scene)
{
  return testNameOf(scene.param.name);
}

/// A built-in scene in a small window, and its truth by rays to many other points of the light.
class SoftSceneTest : public testing::TestWithParam<SoftScene>
{
protected:
  void show(const tool::Scene& scene)
  {
    this->lights_ = scene.lights;
    this->shown = std::make_unique<BuiltinPass>(scene, 128);
    this->shown->choose(radius().c_str());
    this->findTruth("1024");
  }
  /// Return the setting of the sun's size, if the scene has one.
  static std::string radius()
  {
    const char* const degrees = GetParam().sunDegrees;
    return degrees ? std::string("light_radius=") + degrees : "";
  }
  void findTruth(const std::string& samples)
  {
    this->truth = this->shown->draw(("raytraced light_seed=1 light_samples=" + samples).c_str());
    this->shown->choose("light_seed=0");
  }
  tool::VisibilityError errorOf(const char* technique)
  {
    return tool::measureError(this->shown->draw(technique), this->truth, this->lights_);
  }
  /// Expect the mean error to be within a bound, and within a share of the hard shadow's, which may
  /// be small, too.
  /// @return the RMS error
  double expectNearTheTruth(const char* technique, double bound)
  {
    const tool::VisibilityError error = this->errorOf(technique);
    EXPECT_GT(error.facingPixels, 5000);
    EXPECT_LE(error.meanAbsolute, bound);
    EXPECT_LE(error.meanAbsolute, 0.7 * this->errorOf("nsm").meanAbsolute);
    return error.rootMeanSquare;
  }

  std::unique_ptr<BuiltinPass> shown;
  VisibilityImages truth;

private:
  std::vector<tool::SceneLight> lights_;
};

/// A cube over a sphere over a plane, three panels, stacked plates, an elongated cube, the bunny,
/// the atrium.
using SoftScenes = SoftSceneTest;
INSTANTIATE_TEST_SUITE_P(Builtin, SoftScenes,
  testing::Values(SoftScene{ "soft-stack", nullptr, 0.0026 },
    SoftScene{ "soft-panels", nullptr, 0.038 }, SoftScene{ "soft-plates", nullptr, 0.023 },
    SoftScene{ "soft-long-cube", nullptr, 0.0026 }, SoftScene{ "bunny", "5", 0.027 },
    SoftScene{ "atrium", "5", 0.04 }),
  nameOfScene);

} // namespace

TEST_P(SoftScenes, areNearTheTruth)
{
  this->show(tool::loadScene(GetParam().name));
  this->expectNearTheTruth("montecarlo", 0.02);
  this->shown->choose("light_samples=256");
  const double sampled = this->expectNearTheTruth("sampled", 0.005);
  EXPECT_LE(sampled, GetParam().sampledRms);
  EXPECT_LT(sampled, this->errorOf("pcss").rootMeanSquare);
}

namespace
{

/// `auto` in motion, where few probes show an error (thin penumbrae) or it is near the limit.
using MovingSoftScenes = SoftSceneTest;
INSTANTIATE_TEST_SUITE_P(Builtin, MovingSoftScenes,
  testing::Values(SoftScene{ "soft-plates" }, SoftScene{ "soft-long-cube" }), nameOfScene);

} // namespace

TEST_P(MovingSoftScenes, keepTheErrorFromAllSides)
{
  this->show(tool::loadScene(GetParam().name));
  for (int side = 0; side < 12; ++side)
  {
    this->shown->renderer->GetActiveCamera()->Azimuth(30.0);
    this->shown->renderer->ResetCameraClippingRange();
    this->findTruth("256");
    this->shown->draw("auto light_samples=64"); // at rest
    this->shown->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    EXPECT_LE(this->errorOf("auto").rootMeanSquare, 0.03) << side;
    EXPECT_LT(this->shown->report().lights[0].lightSamples, 64);
    this->shown->pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_AUTO);
  }
}

} // namespace gnomon::test
