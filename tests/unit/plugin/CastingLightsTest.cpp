// Every kind of vtkLight, and the settings of each.

#include "PassScene.h"

#include <vtkCollectionRange.h>

#include "shadowtech/base/Kernel.h"

#include <vtkMatrix4x4.h>

using namespace gnomon::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

/// A box and a sphere over a floor, seen at an angle.
class CastingLights : public PassTestOf<Way>
{
protected:
  CastingLights()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -2.0, -1.0, 0.0 }, { -1.0, 0.0, 1.5 });
    this->scene.addSphere({ 0.7, 0.3, 1.5 }, 0.7);
    this->scene.choose(GetParam());
    this->scene.lookFrom({ 1.0, -9.0, 7.0 });
  }

  /// Make a light a scene light without a transform, in the same place.
  static void fix(vtkLight* light)
  {
    double position[3];
    double focalPoint[3];
    light->GetTransformedPosition(position);
    light->GetTransformedFocalPoint(focalPoint);
    light->SetLightTypeToSceneLight();
    light->SetTransformMatrix(nullptr);
    light->SetPosition(position);
    light->SetFocalPoint(focalPoint);
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
  std::size_t shadowed = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      const glm::dvec3 dark(without.at(x, y));
      const glm::dvec3 way = glm::dvec3(all.at(x, y)) - dark;
      const glm::dvec3 shown = glm::dvec3(picture.at(x, y)) - dark;
      const double length2 = std::max(glm::dot(way, way), 1.0);
      double lit = glm::clamp(glm::dot(shown, way) / length2, 0.0, 1.0);
      lit = filters ? lit : std::round(lit);
      const glm::dvec3 off = glm::abs(shown - lit * way);
      EXPECT_LE(std::max({ off.r, off.g, off.b }), filters ? 1.5 : 1.0) << x << ", " << y;
      shadowed += lit == 0.0 && length2 > 3.0 ? 1 : 0;
    }
  }
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

TEST_P(CastingLights, lightsThatFollowTheCameraAreWhereVtkHasThem)
{
  for (const bool head : { true, false })
  {
    this->scene.renderer->RemoveAllLights();
    vtkNew<vtkLight> light;
    light->SetLightType(head ? VTK_LIGHT_TYPE_HEADLIGHT : VTK_LIGHT_TYPE_CAMERA_LIGHT);
    light->SetPosition(-0.8, 0.5, 0.3); // a head light ignores it
    vtkGnomonLightKeys::SetCasts(light, true);
    this->scene.renderer->AddLight(light);
    this->scene.lookFrom({ 1.0, -9.0, 7.0 });
    this->scene.render();
    vtkCamera* camera = this->scene.renderer->GetActiveCamera();
    camera->Azimuth(30.0);
    this->scene.renderer->ResetCameraClippingRange();
    const Picture follows = this->scene.render();
    fix(light);
    if (head)
    {
      light->SetPosition(camera->GetPosition());
      light->SetFocalPoint(camera->GetFocalPoint());
    }
    EXPECT_LE(differingPixels(follows, this->scene.render(), 2), 4u);
    EXPECT_GT(differingPixels(follows, this->scene.renderPlain(), 64), head ? 100u : 300u);
  }
}

TEST_P(CastingLights, aHeadlightAloneCastsIfAsked)
{
  vtkNew<vtkLight> head;
  head->SetLightTypeToHeadlight();
  this->scene.renderer->AddLight(head);
  vtkLight* const other = this->scene.addSun({ 1.0, 0.4, -1.5 });
  other->SwitchOff();
  const auto castingLights = [&]
  {
    this->scene.render();
    const std::vector<gnomon::LightReport>& lights = this->scene.report().lights;
    return std::count_if(lights.begin(), lights.end(), [](const auto& of) { return of.casts; });
  };
  EXPECT_EQ(castingLights(), 0);
  EXPECT_EQ(castingLights(), 0);
  ASSERT_EQ(this->messages_.warnings().size(), 1u) << "said once";
  EXPECT_THAT(this->messages_.warnings().front(), HasSubstr("MakeKeyLight"));
  other->SwitchOn();
  EXPECT_EQ(castingLights(), 1);
  other->SwitchOff();
  vtkGnomonLightKeys::SetCasts(head, true);
  EXPECT_EQ(castingLights(), 1);
  EXPECT_EQ(this->messages_.warnings().size(), 1u);
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

/// A projection that a lamp cannot have does not affect the sun's.
TEST_P(CastingLights, oneLightsTroubleIsItsOwn)
{
  this->scene.addSun({ 1.0, 0.4, -1.5 });
  const auto sunAlone = this->scene.render();
  this->scene.addSpot({ -3.0, -1.0, 4.0 }, { 0.0, 0.0, 0.0 }, 90.0); // a lamp
  for (const char* technique : { "pssm", "lispsm", "tsm" })
  {
    this->scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
    const Picture both = this->scene.render(technique);
    this->scene.render();
    EXPECT_EQ(this->scene.report().lights[0].technique, technique);
    EXPECT_EQ(this->scene.report().lights[1].technique, "nsm");
    EXPECT_TRUE(this->scene.report().lights[1].casts);
    const std::string errors = this->takeErrors();
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
    EXPECT_THAT(errors, HasSubstr("light 1: the projection '"));
    EXPECT_GT(differingPixels(sunAlone, both), 300u);
  }
}

TEST_P(CastingLights, spotLightCastsWithinItsCone)
{
  PassScene scene(300, 300);
  const glm::dvec3 lower(-0.5, -0.5, 1.0);
  const glm::dvec3 upper(0.5, 0.5, 1.5);
  scene.addFloor(5.0);
  scene.addBox(lower, upper);
  scene.choose(GetParam());
  const glm::dvec3 position(-2.0, 0.0, 6.0);
  const glm::dvec3 target(0.5, 0.0, 0.0);
  const double coneAngle = 25.0;
  scene.addSpot(position, target, coneAngle);
  scene.lookDown(4.0);
  const ExactFloor exact = [&](const glm::dvec2& floor)
  {
    if (std::abs(floor.x) < 0.55 && std::abs(floor.y) < 0.55)
    {
      return -1.0; // the box
    }
    const glm::dvec3 toLight = position - glm::dvec3(floor, 0.0);
    const double along = glm::dot(glm::normalize(-toLight), glm::normalize(target - position));
    const bool inCone = along >= std::cos(glm::radians(coneAngle));
    const bool lit = inCone && !hitsBox(floor, toLight, lower, upper);
    // Quantise, so the value stays the same over a few pixels.
    return lit ? std::floor(255.0 * toLight.z / glm::length(toLight) / 40.0) * 40.0 + 20.0 : 0.0;
  };
  const FloorCheck check = checkFloor(scene, scene.render(), exact, 0.06);
  EXPECT_GT(check.counted, 50000u);
  EXPECT_EQ(check.wrong(), 0u);
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
