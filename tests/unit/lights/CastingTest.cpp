// Which lights cast: (lights of the scene, of the camera, at the camera, headlights, VTK's light
// kit) by each choice.

#include "lights/LightManager.h"
#include "lights/vtkGnomonLightKeys.h"

#include <gmock/gmock.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <cstddef>
#include <string>
#include <vector>

using namespace gnomon;

namespace
{

enum class Kind
{
  Scene,
  Camera,
  AtCamera,
  LampAtCamera,
  Head
};

vtkNew<vtkLight> makeLight(Kind kind, double intensity = 1.0)
{
  vtkNew<vtkLight> light;
  light->SetIntensity(intensity);
  switch (kind)
  {
    case Kind::Scene:
      light->SetLightTypeToSceneLight();
      break;
    case Kind::Head:
      light->SetLightTypeToHeadlight();
      break;
    default:
      light->SetLightTypeToCameraLight();
      light->SetPositional(kind == Kind::LampAtCamera);
      light->SetPosition(kind == Kind::Camera ? 0.5 : 0.0, 0.0, 1.0);
      light->SetFocalPoint(0.0, 0.0, 0.0);
  }
  return light;
}

struct Case
{
  const char* name;
  std::vector<std::pair<Kind, double>> lights; ///< with their intensities
  /// The indices of lights that cast, by `auto`, `all` and `brightest`.
  std::vector<int> byAuto, byAll, byBrightest;
};

const Case cases[] = {
  { "scene", { { Kind::Scene, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "camera", { { Kind::Camera, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "atCamera", { { Kind::AtCamera, 1.0 } }, {}, {}, {} },
  { "lampAtCamera", { { Kind::LampAtCamera, 1.0 } }, {}, {}, {} },
  { "head", { { Kind::Head, 1.0 } }, {}, {}, {} },
  { "sceneAndHead", { { Kind::Scene, 0.5 }, { Kind::Head, 1.0 } }, { 0 }, { 0 }, { 0 } },
  { "sceneAndCamera", { { Kind::Scene, 0.5 }, { Kind::Camera, 1.0 } }, { 0, 1 }, { 0, 1 }, { 1 } },
  { "sceneAndAtCamera", { { Kind::AtCamera, 1.0 }, { Kind::Scene, 0.5 } }, { 1 }, { 1 }, { 1 } },
  { "scenes", { { Kind::Scene, 0.5 }, { Kind::Scene, 1.0 } }, { 0, 1 }, { 0, 1 }, { 1 } },
  { "cameras", { { Kind::Camera, 0.5 }, { Kind::Camera, 1.0 }, { Kind::Camera, 1.0 } }, { 1 },
    { 0, 1, 2 }, { 1 } },
  { "all",
    { { Kind::Head, 2.0 }, { Kind::Camera, 0.5 }, { Kind::Scene, 1.0 }, { Kind::Camera, 0.7 } },
    { 2, 3 }, { 1, 2, 3 }, { 2 } },
};

std::vector<int> castingOf(vtkRenderer* renderer, Casting casting)
{
  std::vector<int> indices;
  const LightSet set = LightManager().collect(renderer, {}, casting);
  for (const ShadowLight& light : set.lights)
  {
    indices.push_back(light.sceneIndex);
  }
  EXPECT_EQ(set.lights.size() + set.skipped.size(),
    static_cast<std::size_t>(renderer->GetLights()->GetNumberOfItems()));
  for (const SkippedLight& skipped : set.skipped)
  {
    EXPECT_NE(skipped.reason, "");
  }
  return indices;
}

std::string reasonOf(vtkRenderer* renderer, int index)
{
  for (const SkippedLight& skipped : LightManager().collect(renderer, {}).skipped)
  {
    if (skipped.sceneIndex == index)
    {
      return skipped.reason;
    }
  }
  return "";
}

} // namespace

TEST(Casting, choosesLightsByTheirKind)
{
  for (const Case& of : cases)
  {
    SCOPED_TRACE(of.name);
    vtkNew<vtkRenderer> renderer;
    for (const auto& [kind, intensity] : of.lights)
    {
      renderer->AddLight(makeLight(kind, intensity));
    }
    EXPECT_EQ(castingOf(renderer, Casting::Auto), of.byAuto);
    EXPECT_EQ(castingOf(renderer, Casting::All), of.byAll);
    EXPECT_EQ(castingOf(renderer, Casting::Brightest), of.byBrightest);
    EXPECT_EQ(LightManager().collect(renderer, {}).headlightIsAlone, of.byAll.empty());
  }
}

TEST(Casting, takesALightKitsKeyLight)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLightKit> kit; // key, fill, head and two back lights
  kit->AddLightsToRenderer(renderer);
  ASSERT_EQ(renderer->GetLights()->GetNumberOfItems(), 5);
  const std::vector<int> casting = castingOf(renderer, Casting::Auto);
  ASSERT_EQ(casting.size(), 1u);
  auto* const light =
    vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(casting.front()));
  EXPECT_EQ(light->GetIntensity(), kit->GetKeyLightIntensity());
  EXPECT_EQ(castingOf(renderer, Casting::All).size(), 4u);
  EXPECT_EQ(castingOf(renderer, Casting::Brightest), casting);
}

TEST(Casting, followsALightsKey)
{
  for (const Kind kind :
    { Kind::Scene, Kind::Camera, Kind::AtCamera, Kind::LampAtCamera, Kind::Head })
  {
    for (const Casting casting : { Casting::Auto, Casting::All, Casting::Brightest })
    {
      vtkNew<vtkRenderer> renderer;
      const auto light = makeLight(kind, 0.5);
      const auto brighter = makeLight(Kind::Camera, 1.0);
      renderer->AddLight(light);
      renderer->AddLight(brighter);
      vtkGnomonLightKeys::SetCasts(light, true);
      EXPECT_THAT(castingOf(renderer, casting), testing::ElementsAre(0, 1));
      vtkGnomonLightKeys::SetCasts(light, false);
      vtkGnomonLightKeys::SetCasts(brighter, false);
      EXPECT_THAT(castingOf(renderer, casting), testing::ElementsAre());
    }
  }
}

TEST(Casting, givesReasonsForSkippedLights)
{
  vtkNew<vtkRenderer> renderer;
  const auto head = makeLight(Kind::Head);
  renderer->AddLight(head);
  EXPECT_EQ(reasonOf(renderer, 0), "a headlight, and the only light");
  const auto fill = makeLight(Kind::Camera, 0.2);
  const auto key = makeLight(Kind::Camera, 0.7);
  renderer->AddLight(fill);
  renderer->AddLight(key);
  EXPECT_EQ(reasonOf(renderer, 0), "a headlight");
  EXPECT_EQ(reasonOf(renderer, 1), "it follows the camera, as does a brighter light that casts");
  key->SetDiffuseColor(0.0, 0.0, 1.0); // dimmer by its luminance
  EXPECT_EQ(reasonOf(renderer, 2), "it follows the camera, as does a brighter light that casts");
  EXPECT_EQ(reasonOf(renderer, 1), "");
  key->SwitchOff();
  EXPECT_EQ(reasonOf(renderer, 2), "switched off");
}
