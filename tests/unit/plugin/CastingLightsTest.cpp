// Every kind of vtkLight, and the settings of each.

#include "PassScene.h"

#include <vtkCollectionRange.h>
#include <vtkInformation.h>

#include "shadowtech/base/Kernel.h"

using namespace gnomon::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

/// A box and a sphere over a floor, seen at an angle.
struct CastingLights : PassTestOf<Way>
{
  CastingLights()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -2.0, -1.0, 0.0 }, { -1.0, 0.0, 1.5 });
    this->scene.addSphere({ 0.7, 0.3, 1.5 }, 0.7);
    this->scene.choose(GetParam());
    this->scene.lookFrom({ 1.0, -9.0, 7.0 });
  }

  PassScene scene{ 240, 180 };
};

INSTANTIATE_TEST_SUITE_P(Ways, CastingLights, allWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, CastingLights, testing::Values(planarWay), nameOf);

} // namespace

TEST_P(CastingLights, onlyTheCastingLightIsEverTakenAway)
{
  for (vtkActor* actor : vtk::Range(this->scene.renderer->GetActors()))
  {
    actor->GetProperty()->SetColor(0.9, 0.7, 0.5);
    actor->GetProperty()->SetAmbient(0.2);
    actor->GetProperty()->SetDiffuse(0.6);
    actor->GetProperty()->SetSpecular(0.3);
    actor->GetProperty()->SetSpecularPower(20.0);
  }
  this->scene.renderer->SetBackground(0.1, 0.2, 0.3);
  // Each other light is skipped for another reason. All but the first give light.
  this->scene.addSun({ 1.0, 0.0, -1.0 })->SwitchOff();
  vtkLight* mute = this->scene.addSun({ 0.0, 1.0, -1.0 });
  mute->SetColor(1.0, 0.2, 0.2);
  mute->SetIntensity(0.3);
  vtkGnomonLightKeys::SetCasts(mute, false);
  vtkLight* sun = this->scene.addSun({ 1.0, 0.4, -1.5 });
  sun->SetColor(0.3, 1.0, 0.6);
  sun->SetIntensity(0.7);
  vtkLight* empty = this->scene.addSpot({ -3.0, -3.0, 4.0 }, glm::dvec3(0.0), 0.0);
  empty->SetIntensity(0.2);
  vtkLight* weak = this->scene.addSun({ -1.0, 0.0, -1.0 });
  weak->SetShadowAttenuation(0.0f);
  weak->SetIntensity(0.1);
  this->scene.addSun({ 1.0, 1.0, -1.0 })->SetIntensity(0.0);

  const Picture picture = this->scene.render();
  const std::vector<gnomon::LightReport> lights = this->scene.report().lights;
  ASSERT_EQ(lights.size(), 6u);
  const char* const reasons[] = { "switched off", "marked as not casting", "", "its cone is empty",
    "its shadow attenuation is 0", "gives no light" };
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    EXPECT_EQ(lights[i].sceneIndex, static_cast<int>(i));
    EXPECT_EQ(lights[i].casts, i == 2);
    EXPECT_EQ(lights[i].reason, reasons[i]);
  }

  this->scene.usePlain();
  const Picture all = this->scene.render();
  sun->SetIntensity(0.0);
  const Picture without = this->scene.render();
  const bool filters =
    gnomon::findTechnique(GetParam().technique)->estimator->info.has(gnomon::kernelSettings());
  const std::size_t shadowed = countPixels(picture,
    [&](int x, int y)
    {
      const glm::dvec3 dark(without.at(x, y));
      const glm::dvec3 way = glm::dvec3(all.at(x, y)) - dark;
      const glm::dvec3 shown = glm::dvec3(picture.at(x, y)) - dark;
      const double length2 = std::max(glm::dot(way, way), 1.0);
      double lit = glm::clamp(glm::dot(shown, way) / length2, 0.0, 1.0);
      lit = filters ? lit : std::round(lit);
      const glm::dvec3 off = glm::abs(shown - lit * way);
      EXPECT_LE(std::max({ off.r, off.g, off.b }), filters ? 1.5 : 1.0) << x << ", " << y;
      return lit == 0.0 && length2 > 3.0;
    });
  EXPECT_GT(shadowed, 1000u);
  EXPECT_LT(shadowed, 12000u);
}

TEST_P(CastingLights, strengthOfOneHalfTakesHalfOfTheLight)
{
  vtkLight* sun = this->scene.addSun({ 1.0, 0.4, -1.5 });
  const Picture full = this->scene.render();
  const Picture lit = this->scene.renderPlain();
  sun->SetShadowAttenuation(0.5f);
  const Picture half = this->scene.render();
  const auto isOff = [&](int x, int y)
  { return std::abs(half.red(x, y) - 0.5 * (lit.red(x, y) + full.red(x, y))) > 1.0; };
  const auto isDark = [&](int x, int y) { return full.red(x, y) == 0 && lit.red(x, y) > 0; };
  EXPECT_EQ(countPixels(half, isOff), 0u);
  const std::size_t shadowed = countPixels(full, isDark);
  EXPECT_GT(shadowed, 1000u);
}

TEST_P(CastingLights, followTheCameraAsVtksDo)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.8, 0.5, 0.3);
  vtkGnomonLightKeys::SetCasts(light, true);
  this->scene.renderer->AddLight(light);
  this->scene.render();
  this->scene.renderer->GetActiveCamera()->Azimuth(30.0);
  this->scene.renderer->ResetCameraClippingRange();
  const Picture follows = this->scene.render();
  light->GetInformation()->Clear(); // without the key
  vtkNew<vtkLight> dim;
  dim->DeepCopy(light);
  dim->SetIntensity(0.01);
  this->scene.renderer->AddLight(dim);
  this->scene.pass->SetCasting(vtkGnomonShadowPass::CASTING_ALL);
  EXPECT_LE(differingPixels(follows, this->scene.render(), 4), 0u);
  EXPECT_TRUE(this->scene.report().lights.at(1).casts);
  this->scene.renderer->RemoveLight(dim);
  const glm::dvec3 position = glm::make_vec3(light->GetTransformedPosition());
  const glm::dvec3 target = glm::make_vec3(light->GetTransformedFocalPoint());
  light->SetLightTypeToSceneLight();
  light->SetTransformMatrix(nullptr);
  aim(light, position, target);
  EXPECT_LE(differingPixels(follows, this->scene.render(), 2), 4u);
  EXPECT_GT(differingPixels(follows, this->scene.renderPlain(), 64), 300u);
}

TEST_P(CastingLights, noneAtAllIsNoted)
{
  this->scene.render();
  EXPECT_THAT(this->scene.report().notes, testing::Contains(HasSubstr("no light")));
  this->scene.addSun({ 1.0, 0.4, -1.5 });
  this->scene.render();
  EXPECT_THAT(this->scene.report().notes, testing::Not(testing::Contains(HasSubstr("no light"))));
}

/// Nothing is drawn in a viewport without pixels, and nothing said; one that is partly outside of
/// the window is drawn as VTK draws it.
TEST_P(CastingLights, viewportsMayHaveNoPixels)
{
  this->scene.addSun({ 1.0, 0.4, -1.5 });
  const Picture shadowed = this->scene.render();
  for (const std::array<double, 4>& place :
    { std::array{ 0.0, 0.0, 0.0, 0.0 }, { 0.5, 0.5, 0.5, 0.5 }, { 0.0, 0.0, 0.001, 1.0 },
      { -0.5, 0.0, 1.0, 1.0 }, { 0.0, 0.0, 1.0, 1.0 } })
  {
    this->scene.renderer->SetViewport(place[0], place[1], place[2], place[3]);
    const Picture plain = this->scene.renderPlain();
    const Picture drawn = this->scene.render();
    const bool isSeen = place[2] - place[0] > 0.5;
    EXPECT_EQ(this->scene.report().route == "none", !isSeen);
    EXPECT_EQ(differingPixels(drawn, plain) > 100, isSeen);
  }
  EXPECT_EQ(differingPixels(this->scene.render(), shadowed), 0u);
}

TEST_P(CastingLights, eachLightHasItsOwnTechniqueInOneFrame)
{
  this->scene.pass->KeepVisibilityOn();
  this->scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
  vtkLight* first = this->scene.addSun({ 1.0, 0.4, -1.5 });
  vtkLight* second = this->scene.addSun({ -1.0, 0.4, -1.5 });
  const gnomon::VisibilityImages traced = drawKept(this->scene, "raytraced");
  const gnomon::VisibilityImages mapped = drawKept(this->scene, "nsm");

  vtkGnomonLightKeys::SetTechnique(first, "nsm");
  vtkGnomonLightKeys::SetTechnique(second, "raytraced");
  vtkGnomonLightKeys::SetMapSize(first, 256);
  this->scene.render();
  const gnomon::FrameReport& report = this->scene.report();
  EXPECT_EQ(report.route, "image");
  EXPECT_THAT(report.routeReason, HasSubstr("raytraced"));
  EXPECT_EQ(report.lights[0].technique, "nsm");
  EXPECT_EQ(report.lights[0].mapSizeTexels, 256);
  EXPECT_EQ(report.lights[0].tracedPixels, 0);
  EXPECT_EQ(report.lights[1].technique, "raytraced");
  EXPECT_EQ(report.lights[1].mapSizeTexels, 0);
  EXPECT_GT(report.lights[1].tracedPixels, 10000);
  EXPECT_EQ(report.bytesMaps, 256u * 256u * 4u);
  const gnomon::VisibilityImages mixed = this->scene.pass->GetVisibility();
  EXPECT_THAT(mixed.sceneIndices, ElementsAre(0, 1));
  EXPECT_EQ(mixed.visibility[1], traced.visibility[1]);
  vtkGnomonLightKeys::SetMapSize(first, 0); // back to the pass's size
  this->scene.render();
  EXPECT_EQ(this->scene.pass->GetVisibility().visibility[0], mapped.visibility[0]);
  EXPECT_NE(mixed.visibility[0], mapped.visibility[0]);
}
