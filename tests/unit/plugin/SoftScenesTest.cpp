// Techniques with soft shadows in built-in scenes: bounds of their mean error against rays.

#include "BuiltinScenes.h"
#include "Comparison.h"
#include "HalfPlane.h"
#include "PassScene.h"
#include "Scene.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "plugin/vtkGnomonVisibilityImages.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

struct SoftScene
{
  const char* name;
  const char* sunDegrees = nullptr; ///< null: the scene has a lamp
  double sampledRms = 0.0;          ///< the largest of `sampled` with 256 points
  const char* ground = "plane";     ///< a model
};

void PrintTo(const SoftScene& scene, std::ostream* stream)
{
  *stream << scene.name;
}

std::string nameOfScene(const testing::TestParamInfo<SoftScene>& scene)
{
  std::string name = scene.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

using SceneSettings = std::vector<std::pair<const char*, const char*>>;

/// A built-in scene in a window of 128 x 128 pixels, with maps of 1024.
class SoftSceneTest : public testing::TestWithParam<SoftScene>
{
protected:
  SoftSceneTest() { this->window_->SetMultiSamples(0); }

  void show(const tool::Scene& scene)
  {
    this->lights_ = scene.lights;
    this->renderer_ = tool::makeRenderer(scene, 1.0);
    this->renderer_->SetPass(this->pass_);
    this->window_->SetSize(128, 128);
    this->window_->AddRenderer(this->renderer_);
    this->pass_->KeepVisibilityOn();
    this->pass_->SmoothTerminatorsOff();
    if (GetParam().sunDegrees)
    {
      this->pass_->SetSetting("light_radius", GetParam().sunDegrees);
    }
    this->findTruth("1024");
  }

  void findTruth(const char* samples)
  {
    this->truth_ = this->draw("raytraced", { { "light_samples", samples }, { "light_seed", "1" } });
    this->pass_->SetSetting("light_seed", "0");
  }

  /// Turn the camera and return the error of the first frame that moves.
  double errorOfMotion(double degrees)
  {
    this->renderer_->GetActiveCamera()->Azimuth(degrees);
    this->renderer_->ResetCameraClippingRange();
    this->findTruth("256");
    this->draw("auto", { { "light_samples", "64" } }); // at rest
    this->pass_->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
    const double error = this->errorOf(this->draw("auto", {})).rootMeanSquare;
    this->pass_->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_AUTO);
    EXPECT_LT(this->pass_->GetReport().lights[0].lightSamples, 64);
    return error;
  }

  /// Compare with rays to 1,024 other points of the light, over the pixels that face it. Expect the
  /// mean absolute error to be within a bound, and within a share of the hard shadow's, which may
  /// be small, too.
  tool::VisibilityError expectNearTheTruth(
    const char* technique, const SceneSettings& settings, double bound)
  {
    const tool::VisibilityError error = this->errorOf(this->draw(technique, settings));
    const tool::VisibilityError hard = this->errorOf(this->draw("nsm", {}));
    EXPECT_GT(error.facingPixels, 5000);
    EXPECT_LE(error.meanAbsolute, bound);
    EXPECT_LE(error.meanAbsolute, 0.7 * hard.meanAbsolute);
    this->RecordProperty("mean_absolute_error", std::to_string(error.meanAbsolute));
    this->RecordProperty("rms_error", std::to_string(error.rootMeanSquare));
    this->RecordProperty("hard_mean_absolute_error", std::to_string(hard.meanAbsolute));
    return error;
  }

  /// Count only some receivers.
  void countOnly(const std::function<bool(const glm::dvec3& positionWorld)>& counts)
  {
    for (std::size_t i = 0; i < this->truth_.coverage.size(); ++i)
    {
      this->truth_.coverage[i] =
        counts(positionOf(this->truth_, i)) ? this->truth_.coverage[i] : 0.0f;
    }
  }

  tool::VisibilityError errorOf(const VisibilityImages& images) const
  {
    return tool::measureError(images, this->truth_, this->lights_);
  }

  /// The mean visibility of pixels that, in truth, see a part of the light.
  struct Dimmed
  {
    int pixels = 0;
    double mean = 0.0;
  };
  Dimmed dimmed(const VisibilityImages& images) const
  {
    Dimmed dimmed;
    for (std::size_t i = 0; i < this->truth_.coverage.size(); ++i)
    {
      const float truth = this->truth_.visibility[0][i];
      if (this->truth_.coverage[i] == 1.0f && truth > 0.0f && truth < 1.0f)
      {
        ++dimmed.pixels;
        dimmed.mean += images.visibility[0][i];
      }
    }
    dimmed.mean /= dimmed.pixels;
    return dimmed;
  }

  const VisibilityImages& truth() const { return this->truth_; }

  VisibilityImages draw(const char* technique, const SceneSettings& settings)
  {
    this->pass_->SetTechnique(technique);
    for (const auto& [name, value] : settings)
    {
      this->pass_->SetSetting(name, value);
    }
    this->window_->Render();
    return this->pass_->GetVisibility();
  }

private:
  vtkNew<vtkGnomonEGLRenderWindow> window_;
  vtkNew<vtkGnomonShadowPass> pass_;
  vtkSmartPointer<vtkRenderer> renderer_;
  std::vector<tool::SceneLight> lights_;
  VisibilityImages truth_;
};

//------------------------------------------------------------------------------
/// A cube over a sphere over a plane, three panels, stacked plates, an elongated cube, the bunny,
/// the atrium.
using SoftScenes = SoftSceneTest;

INSTANTIATE_TEST_SUITE_P(Builtin, SoftScenes,
  testing::Values(SoftScene{ "soft-stack", nullptr, 0.0026 },
    SoftScene{ "soft-panels", nullptr, 0.038 }, SoftScene{ "soft-plates", nullptr, 0.023 },
    SoftScene{ "soft-long-cube", nullptr, 0.0026 }, SoftScene{ "bunny", "5", 0.027 },
    SoftScene{ "atrium", "5", 0.04 }),
  nameOfScene);

TEST_P(SoftScenes, sampledAndFilteredRaysThroughPeeledLayersAreNearTheTruth)
{
  this->show(tool::loadScene(GetParam().name));
  this->expectNearTheTruth("montecarlo", {}, 0.02);
  const tool::VisibilityError error =
    this->expectNearTheTruth("sampled", { { "light_samples", "256" } }, 0.005);
  EXPECT_LE(error.rootMeanSquare, GetParam().sampledRms);
  const double guessed = this->errorOf(this->draw("pcss", {})).rootMeanSquare;
  RecordProperty("pcss_rms_error", std::to_string(guessed));
  EXPECT_LT(error.rootMeanSquare, guessed);
}

//------------------------------------------------------------------------------
/// A cube over a sphere: the part of the lamp that both hide.
using SoftStack = SoftSceneTest;

INSTANTIATE_TEST_SUITE_P(
  Builtin, SoftStack, testing::Values(SoftScene{ "soft-stack" }), nameOfScene);

/// The sphere from near by. A part of the cube's penumbra dims its left half (Apelles, figure 5.6).
TEST_P(SoftStack, dimsTheSphereAsRaysDoAndPcssLessWell)
{
  tool::Scene scene = tool::loadScene(GetParam().name);
  const glm::dvec3 middle(0.0, 1.7, 0.0);
  const double radius = 1.2;
  scene.camera.target = { { middle.x, middle.y + 0.7 * radius, middle.z } };
  scene.camera.fovDegrees = 10.0;
  this->show(scene);
  const VisibilityImages sampled = this->draw("sampled", { { "light_samples", "256" } });
  const VisibilityImages guessed = this->draw("pcss", {});
  for (const bool leftHalf : { false, true })
  {
    this->countOnly([&](const glm::dvec3& at)
      { return glm::distance(at, middle) < 1.01 * radius && (!leftHalf || at.x < 0.0); });
    const Dimmed truth = this->dimmed(this->truth());
    const double sampledRms = this->errorOf(sampled).rootMeanSquare;
    const double guessedRms = this->errorOf(guessed).rootMeanSquare;
    const std::string of = leftHalf ? "_left_half" : "_sphere";
    RecordProperty("rms" + of, std::to_string(sampledRms) + " pcss " + std::to_string(guessedRms));
    RecordProperty("dimmed" + of,
      std::to_string(truth.pixels) + " pixels: " + std::to_string(truth.mean) + " sampled " +
        std::to_string(this->dimmed(sampled).mean) + " pcss " +
        std::to_string(this->dimmed(guessed).mean));
    EXPECT_GT(truth.pixels, 100) << of;
    EXPECT_LT(sampledRms, 0.7 * guessedRms) << of;
    const double meanOff = std::abs(this->dimmed(sampled).mean - truth.mean);
    EXPECT_LT(meanOff, 0.005) << of;
    EXPECT_LT(meanOff, 0.5 * std::abs(this->dimmed(guessed).mean - truth.mean)) << of;
  }
}

//------------------------------------------------------------------------------
/// Scenes whose ground is one model.
using SoftScenesOnGrounds = SoftSceneTest;

INSTANTIATE_TEST_SUITE_P(Builtin, SoftScenesOnGrounds,
  testing::Values(SoftScene{ "soft-stack" }, SoftScene{ "soft-panels", nullptr, 0.0, "bottom" },
    SoftScene{ "soft-plates" }, SoftScene{ "soft-long-cube" }),
  nameOfScene);

TEST_P(SoftScenesOnGrounds, filteredRaysThroughTwoLayersAreNearTheTruthWhereTheyCastNothing)
{
  tool::Scene scene = tool::loadScene(GetParam().name);
  const auto ground = std::find_if(scene.models.begin(), scene.models.end(),
    [](const tool::SceneModel& model) { return model.name == GetParam().ground; });
  ASSERT_NE(ground, scene.models.end());
  ground->casts = false;
  this->show(scene);
  this->expectNearTheTruth("montecarlo", { { "mc_layers", "near_far" } }, 0.02);
}

//------------------------------------------------------------------------------
// Half a plane over a plane
//------------------------------------------------------------------------------

/// Return the visible share of a sun of this angle from (x, 0, z), past the edge of the scene
/// `half-plane` at x = 0, y = 2.5.
double halfPlaneAt(double x, double degrees)
{
  const double height = 2.5;
  const glm::dvec3 toSun =
    glm::normalize(glm::dvec3(-tool::halfPlaneShadowEdge / height, 1.0, 0.3));
  // A ray along r is at x + height r.x / r.y when it is as high as the edge. Rays to the points of
  // the sun, one unit away, that pass the edge lie on one side of a line.
  const glm::dvec3 across(height, x, 0.0);
  const double along = glm::dot(across, toSun);
  const double radii =
    along / (glm::length(across - along * toSun) * std::tan(glm::radians(0.5 * degrees)));
  return diskShare(radii);
}

/// The width holds although the filter's radius is in pixels, and the penumbra a few pixels wide.
TEST(SoftHalfPlane, montecarloLeavesThePenumbraAsWideAsItIs)
{
  const vtkSmartPointer<vtkRenderer> renderer =
    tool::makeRenderer(tool::loadScene("half-plane"), 1.0);
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkGnomonShadowPass> pass;
  pass->SmoothTerminatorsOff();
  pass->KeepVisibilityOn();
  pass->SetTechnique("montecarlo");
  pass->SetSetting("light_radius", "6");
  renderer->SetPass(pass);
  for (const int side : { 256, 512 })
  {
    window->SetSize(side, side);
    window->Render();
    const VisibilityImages& kept = pass->GetVisibility();
    // Sums of the light beyond the hard shadow's edge, weighted by distance: they grow as the
    // square of the penumbra's width.
    double spread = 0.0;
    double exactSpread = 0.0;
    std::array<double, 10> offBy{}; // sums, by the visible share
    std::array<double, 10> pixels{};
    for (std::size_t i = 0; i < kept.coverage.size(); ++i)
    {
      const double y = kept.positionY[i] + kept.origin[1];
      if (kept.coverage[i] < 0.5f || std::abs(y) > 1e-3)
      {
        continue;
      }
      const double x = kept.positionX[i] + kept.origin[0];
      const double exact = halfPlaneAt(x, 6.0);
      const double seen = kept.visibility[0][i];
      const double beyond = x - tool::halfPlaneShadowEdge;
      spread += std::abs(beyond) * (beyond < 0.0 ? seen : 1.0 - seen);
      exactSpread += std::abs(beyond) * (beyond < 0.0 ? exact : 1.0 - exact);
      if (exact > 0.0 && exact < 1.0)
      {
        const auto tenth = static_cast<std::size_t>(10.0 * exact);
        offBy[tenth] += seen - exact;
        pixels[tenth] += 1.0;
      }
    }
    const double width = std::sqrt(spread / exactSpread); // relative to the exact one
    RecordProperty("width_" + std::to_string(side), std::to_string(width));
    EXPECT_NEAR(width, 1.0, 0.05) << side;
    for (std::size_t tenth = 0; tenth < offBy.size(); ++tenth)
    {
      EXPECT_GT(pixels[tenth], 100.0) << side;
      EXPECT_NEAR(offBy[tenth] / pixels[tenth], 0.0, 0.05) << side << ", " << tenth;
    }
  }
}

//------------------------------------------------------------------------------
/// `auto` in motion, where few probes show an error (thin penumbrae) or it is near the limit.
using MovingSoftScenes = SoftSceneTest;

INSTANTIATE_TEST_SUITE_P(Builtin, MovingSoftScenes,
  testing::Values(SoftScene{ "soft-plates" }, SoftScene{ "soft-long-cube" }), nameOfScene);

TEST_P(MovingSoftScenes, keepTheErrorFromAllSides)
{
  this->show(tool::loadScene(GetParam().name));
  for (int side = 0; side < 12; ++side)
  {
    EXPECT_LE(this->errorOfMotion(30.0), 0.03) << side;
  }
}

} // namespace
} // namespace gnomon::test
