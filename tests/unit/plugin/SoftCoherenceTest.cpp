// `coherence` under area lights: eight maps decide where they agree, all samples decide the rest.

#include "BuiltinPass.h"
#include "PassScene.h"
#include "Scene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

/// The result of `coherence` in a frame, against all rays.
struct Hints
{
  std::size_t reached = 0; ///< pixels that a ray could decide
  std::size_t traced = 0;
  std::size_t wrong = 0; ///< pixels decided by maps that differ from all rays
  double worst = 0.0;    ///< their largest error
};

/// Compare the first light's images. Pixels that are traced have to be the truth, to the last bit.
Hints countHints(const VisibilityImages& kept, const std::vector<float>& truth)
{
  Hints hints;
  const ClassImage& classes = kept.classes.at(0);
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const std::string& of = classes.classes[classes.ofPixels[i]].name;
    const bool traced = of.find("traced") != std::string::npos;
    const bool hinted = of.find("hinted") != std::string::npos;
    const float visibility = kept.visibility[0][i];
    hints.reached += traced || hinted ? 1 : 0;
    hints.traced += traced ? 1 : 0;
    if (!hinted)
    {
      EXPECT_EQ(visibility, truth[i]) << of;
      continue;
    }
    EXPECT_EQ(visibility, of == "hinted lit" ? 1.0f : 0.0f);
    hints.wrong += visibility != truth[i] ? 1 : 0;
    hints.worst = std::max(hints.worst, std::abs(static_cast<double>(visibility) - truth[i]));
  }
  return hints;
}

double share(std::size_t pixels, const Hints& hints)
{
  return static_cast<double>(pixels) / static_cast<double>(hints.reached);
}

//------------------------------------------------------------------------------
// Built-in scenes
//------------------------------------------------------------------------------

struct SceneCase
{
  const char* name;
  double traced; ///< the largest share of `reached`
  double wrong;  ///< the largest share of `reached`
};

void PrintTo(const SceneCase& scene, std::ostream* stream)
{
  *stream << scene.name;
}

class SoftCoherenceScenes : public testing::TestWithParam<SceneCase>
{
};

INSTANTIATE_TEST_SUITE_P(Builtin, SoftCoherenceScenes,
  testing::Values(SceneCase{ "soft-stack", 0.09, 0.0006 },
    SceneCase{ "soft-panels", 0.125, 0.00025 }, SceneCase{ "soft-plates", 0.021, 0.00005 },
    SceneCase{ "soft-long-cube", 0.072, 0.0007 }, SceneCase{ "bunny", 0.043, 0.0005 },
    SceneCase{ "cups", 0.06, 0.0001 }, SceneCase{ "posts", 0.072, 0.0001 },
    SceneCase{ "terrain", 0.09, 0.0025 }),
  [](const testing::TestParamInfo<SceneCase>& scene) { return testNameOf(scene.param.name); });

TEST_P(SoftCoherenceScenes, traceTheRestAndAreSeldomWrong)
{
  const BuiltinPass scene(GetParam().name, 256);
  scene.pass->SetSetting("light_samples", "64");
  if (std::string(GetParam().name).rfind("soft-", 0) != 0)
  {
    scene.pass->SetSetting("light_radius", "3"); // degrees, or world units
  }
  scene.pass->SetTechnique("raytraced");
  scene.window->Render();
  const std::vector<float> truth = scene.pass->GetVisibility().visibility.at(0);
  scene.pass->SetTechnique("coherence");
  scene.window->Render();
  const Hints hints = countHints(scene.pass->GetVisibility(), truth);
  ASSERT_GT(hints.reached, 1000u);
  RecordProperty("traced", std::to_string(share(hints.traced, hints)));
  RecordProperty("wrong", std::to_string(share(hints.wrong, hints)));
  RecordProperty("worst", std::to_string(hints.worst));
  EXPECT_LE(share(hints.traced, hints), GetParam().traced);
  EXPECT_LE(share(hints.wrong, hints), GetParam().wrong);

  const LightReport& report = scene.pass->GetReport().lights.at(0);
  EXPECT_EQ(report.lightSamples, 64);
  EXPECT_EQ(report.tracedPixels, static_cast<std::int64_t>(hints.traced));
  EXPECT_EQ(report.rays, 64 * report.tracedPixels);
}

//------------------------------------------------------------------------------
// All kinds of lights
//------------------------------------------------------------------------------

/// Adds a light to a scene.
using AddLight = std::function<vtkLight*(PassScene&)>;

AddLight sun(const char* degrees)
{
  return [=](PassScene& scene)
  {
    vtkLight* light = scene.addSun({ 0.4, 0.5, -1.0 });
    vtkGnomonLightKeys::SetSetting(light, "light_radius", degrees);
    return light;
  };
}

AddLight lamp(double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    vtkLight* light = scene.addSpot({ -2.0, -2.5, 6.0 }, glm::dvec3(0.0), coneAngleDegrees);
    vtkGnomonLightKeys::SetSetting(light, "light_radius", "0.5");
    return light;
  };
}

vtkLight* addRectangle(PassScene& scene)
{
  vtkNew<vtkGnomonAreaLight> light;
  light->SetPosition(-2.0, -2.5, 6.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetConeAngle(50.0);
  light->SetShapeToRectangle();
  light->SetWidth(1.5);
  light->SetHeight(0.4);
  scene.renderer->AddLight(light);
  return light;
}

/// Its near face cuts the sphere and the box.
vtkLight* addBoxedSun(PassScene& scene)
{
  vtkLight* light = sun("8")(scene);
  const double up[3] = { 0.3, 1.0, 0.0 };
  light->SetPosition(-0.2, -0.25, 0.5);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  vtkGnomonLightKeys::SetBox(light, 5.0, 4.0, 8.0, up);
  return light;
}

struct LightCase
{
  const char* name;
  AddLight add;
};

void PrintTo(const LightCase& light, std::ostream* stream)
{
  *stream << light.name;
}

class SoftCoherence : public PassTest
{
protected:
  static void addThings(PassScene& scene)
  {
    scene.addFloor(4.0);
    scene.addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
    scene.addSphere({ 1.3, 0.8, 1.4 }, 0.5);
    scene.lookFrom({ 2.0, -8.0, 7.0 });
  }
};

class SoftCoherenceLights
  : public SoftCoherence
  , public testing::WithParamInterface<LightCase>
{
};

INSTANTIATE_TEST_SUITE_P(Lights, SoftCoherenceLights,
  testing::Values(LightCase{ "sun", sun("6") }, LightCase{ "spot", lamp(50.0) },
    LightCase{ "wideSpot", lamp(75.0) }, LightCase{ "ball", lamp(allDirections) },
    LightCase{ "rectangle", addRectangle }, LightCase{ "box", addBoxedSun }),
  [](const testing::TestParamInfo<LightCase>& light) { return std::string(light.param.name); });

TEST_P(SoftCoherenceLights, areWhatAllRaysShow)
{
  PassScene scene(160, 120);
  addThings(scene);
  GetParam().add(scene);
  scene.pass->SetMapSize(512);
  scene.pass->SetTechnique("raytraced");
  const std::vector<float> truth = drawKept(scene).visibility.at(0);
  scene.pass->SetTechnique("coherence");
  const Hints hints = countHints(drawKept(scene), truth);
  EXPECT_EQ(scene.report().mapBakes, 8);
  EXPECT_LE(share(hints.traced, hints), 0.08);
  EXPECT_LE(share(hints.wrong, hints), 0.0015);
  EXPECT_LE(hints.worst, 0.05); // single samples of 64

  drawKept(scene);
  EXPECT_EQ(scene.report().mapBakes, 0) << "of a static scene";
}

TEST_P(SoftCoherenceLights, followWhatMoves)
{
  PassScene scene(100, 80);
  addThings(scene);
  vtkLight* light = GetParam().add(scene);
  vtkActor* caster = scene.addBox({ -2.5, 1.0, 0.5 }, { -1.5, 2.0, 1.5 });
  scene.pass->SetMapSize(128);
  scene.pass->SetSetting("light_samples", "16");
  scene.pass->SetTechnique("coherence");
  const auto expectFresh = [&](const char* what)
  {
    const std::vector<float> followed = drawKept(scene).visibility.at(0);
    vtkNew<vtkGnomonShadowPass> fresh; // a pass without earlier frames
    fresh->SmoothTerminatorsOff();
    fresh->SetMapSize(128);
    fresh->SetSetting("light_samples", "16");
    fresh->SetTechnique("coherence");
    fresh->KeepVisibilityOn();
    scene.renderer->SetPass(fresh);
    scene.window->Render();
    EXPECT_EQ(fresh->GetVisibility().visibility.at(0), followed) << what;
    scene.renderer->SetPass(scene.pass);
  };
  expectFresh("at first");
  caster->SetPosition(1.0, -2.0, 0.0); // within the bounds of all
  expectFresh("a caster");
  light->SetPosition(
    light->GetPosition()[0] + 0.7, light->GetPosition()[1], light->GetPosition()[2]);
  expectFresh("the light");
  vtkGnomonLightKeys::SetSetting(light, "light_radius", light->GetPositional() ? "1.2" : "12");
  expectFresh("its size");
  scene.lookFrom({ -3.0, -7.0, 6.0 });
  expectFresh("the camera");
  scene.pass->SetTechnique("nsm");
  drawKept(scene);
  scene.pass->SetTechnique("coherence");
  expectFresh("the technique");
}

/// A light of size 0 is its centre, and takes one map.
TEST_F(SoftCoherence, ofNoSizeIsHard)
{
  PassScene scene(100, 80);
  addThings(scene);
  vtkLight* light = lamp(50.0)(scene);
  scene.pass->SetTechnique("coherence");
  drawKept(scene);
  EXPECT_EQ(scene.report().lights[0].lightSamples, 64);
  const std::size_t bytes = scene.report().bytesMaps;
  vtkGnomonLightKeys::SetSetting(light, "light_radius", "0");
  const std::vector<float> hard = drawKept(scene).visibility.at(0);
  EXPECT_EQ(scene.report().lights[0].lightSamples, 1);
  EXPECT_LT(scene.report().bytesMaps, bytes / 6);
  EXPECT_EQ(
    std::count_if(hard.begin(), hard.end(), [](float v) { return v != 0.0f && v != 1.0f; }), 0);
}

/// Points of the light below a floor do not count: if the others are hidden, all of the light is.
TEST_F(SoftCoherence, asksPointsThatTheReceiverFaces)
{
  PassScene scene(100, 80);
  scene.addBox({ -4.0, -4.0, -0.2 }, { 4.0, 4.0, 0.0 });
  scene.addBox({ 2.0, -3.0, 0.0 }, { 2.2, 3.0, 3.0 });
  scene.lookFrom({ -4.0, -8.0, 7.0 });
  vtkNew<vtkGnomonAreaLight> light;
  light->SetPosition(5.0, 0.0, 0.5);
  light->SetFocalPoint(0.0, 0.0, 0.5);
  light->SetConeAngle(90.0);
  light->SetRadius(1.0);
  scene.renderer->AddLight(light);
  scene.pass->SetTechnique("raytraced");
  const std::vector<float> truth = drawKept(scene).visibility.at(0);
  scene.pass->SetTechnique("coherence");
  const Hints hints = countHints(drawKept(scene), truth);
  EXPECT_LT(share(hints.traced, hints), 0.25);
  EXPECT_LT(share(hints.wrong, hints), 0.001);
}

} // namespace
} // namespace gnomon::test
