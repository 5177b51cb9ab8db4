// Users' wishes for shadows (docs/guide/from_vtkShadowMapPass.md): a map and the default technique
// have no pixel that contradicts the shadow's closed form. The page names tests of other suites for
// other wishes.

#include "PassScene.h"

#include <cstdlib>

namespace gnomon::test
{
namespace
{

class Wishes : public PassTest
{
protected:
  /// @param technique one with a map
  /// @param wrong draws the scene and counts the pixels that violate the wish
  static void judge(PassScene& scene, const std::function<std::size_t()>& wrong, int mapSize = 1024,
    const char* technique = "nsm")
  {
    scene.pass->SetMapSize(mapSize);
    for (const char* each : { technique, "auto" })
    {
      scene.pass->SetTechnique(each);
      EXPECT_EQ(wrong(), 0u) << each;
    }
  }
};

/// Return the picture with pixels white unless their red is dark: for lamps, whose light falls off.
Picture litOrDark(Picture picture)
{
  for (unsigned char& value : picture.rgb)
  {
    value = value > 64 ? 255 : 0;
  }
  return picture;
}

/// Return the exact result of litOrDark() for the floor around a box under one lamp; negative where
/// a slightly larger or smaller box changes the answer.
ExactFloor floorUnderLamp(const Box& box, const glm::dvec3& lamp)
{
  return [=](const glm::dvec2& floor)
  {
    const auto isInShadow = [&](double grown)
    { return hitsBox(floor, lamp - glm::dvec3(floor, 0.0), box.lower - grown, box.upper + grown); };
    if (isUnder(floor, box) || isInShadow(0.05) != isInShadow(-0.05))
    {
      return -1.0;
    }
    return isInShadow(0.0) ? 0.0 : 255.0;
  };
}

/// A box over a floor under a slanting sun, seen from above.
struct SeenBox : BoxScene
{
  SeenBox(const Box& of, double halfSide, double halfHeight, int side = 200)
    : BoxScene(side, side, of, halfSide)
  {
    this->lookDown(halfHeight);
  }
  /// Count the wrong pixels, except in a band beside edges.
  std::size_t wrong(double band) { return this->check(this->render(), band).wrong(); }
};

/// A box on a floor under a lamp.
struct LampScene : SeenBox
{
  explicit LampScene(double coneAngleDegrees)
    : SeenBox(standingBox, 10.0, 4.0)
    , lamp(this->addSpot(place, glm::dvec3(0.0), coneAngleDegrees))
  {
    this->renderer->RemoveLight(this->sun);
  }
  std::size_t wrong()
  {
    return checkFloor(*this, litOrDark(this->render()), floorUnderLamp(this->box, place), 0.1)
      .wrong();
  }
  const glm::dvec3 place{ -6.0, 0.0, 8.0 };
  vtkLight* lamp;
};

} // namespace

TEST_F(Wishes, anyWindowShape)
{
  SeenBox scene(hangingBox, 10.0, 5.0);
  for (const auto& [width, height] :
    { std::pair(300, 150), { 640, 200 }, { 120, 360 }, { 301, 299 }, { 1920, 1080 } })
  {
    scene.window->SetSize(width, height);
    judge(scene, [&] { return scene.wrong(0.14); });
  }
}

TEST_F(Wishes, darkAtContact)
{
  SeenBox scene(standingBox, 100.0, 4.0);
  judge(
    scene, [&] { return scene.wrong(0.3); }, 2048);
}

/// A long strip across the sun's direction, which makes the texels of a map of all of it coarse.
TEST_F(Wishes, resolutionWhereTheCameraLooks)
{
  SeenBox scene(hangingBox, 6.0, 5.0);
  scene.floor()->SetScale(1.0, 400.0 / 6.0, 1.0);
  judge(
    scene, [&] { return scene.wrong(0.15); }, 1024, "pssm");
}

TEST_F(Wishes, physicallyBasedUnderASpot)
{
  LampScene scene(60.0);
  for (vtkActor* actor : { scene.floor(), scene.renderer->GetActors()->GetLastActor() })
  {
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(1.0);
  }
  scene.lamp->SetIntensity(10.0);
  judge(scene, [&] { return scene.wrong(); });
}

TEST_F(Wishes, lampsOfAnyConeCast)
{
  LampScene scene(allDirections);
  for (const double cone : { allDirections, 120.0, 90.0 })
  {
    scene.lamp->SetConeAngle(cone);
    judge(scene, [&] { return scene.wrong(); });
  }
}

TEST_F(Wishes, lightsThatAreOffShiftNoOthers)
{
  SeenBox scene(hangingBox, 10.0, 10.0);
  scene.renderer->RemoveLight(scene.sun);
  scene.addSun({ 0.0, 1.0, -1.0 })->SwitchOff();
  scene.addSun(slantingSun);
  judge(scene, [&] { return scene.wrong(0.2); });
}

TEST_F(Wishes, invisiblePropsChangeNothing)
{
  SeenBox scene(hangingBox, 10.0, 10.0);
  scene.addBox(glm::dvec3(-1000.0), glm::dvec3(1000.0))->VisibilityOff();
  judge(scene, [&] { return scene.wrong(0.2); });
}

TEST_F(Wishes, severalShadowsOfChosenDirections)
{
  SeenBox scene(standingBox, 10.0, 5.0);
  scene.renderer->RemoveAllLights();
  const std::vector<glm::dvec3> directions = { { 1.0, 0.0, -1.0 }, { -1.0, 1.0, -1.0 },
    { 0.0, -1.0, -1.0 } };
  std::vector<vtkLight*> lights;
  for (const glm::dvec3& direction : directions)
  {
    lights.push_back(scene.addSun(direction));
    lights.back()->SetIntensity(0.5);
  }
  const ExactFloor exact = floorUnderHalfSuns(standingBox, directions);
  const auto wrong = [&] { return checkFloor(scene, scene.render(), exact, 0.2).wrong(); };
  judge(scene, wrong);
  // Lights that follow the camera, whose x, y and z are the world's.
  scene.pass->SetCasting(vtkGnomonShadowPass::CASTING_ALL);
  for (vtkLight* light : lights)
  {
    light->SetLightTypeToCameraLight();
  }
  judge(scene, wrong);
}

/// On the sun's side, the floor darkens towards the box by occlusion alone.
TEST_F(Wishes, ambientOcclusionStaysOn)
{
  SeenBox scene(standingBox, 10.0, 4.0);
  scene.usePlain();
  const Picture plain = scene.render();
  scene.renderer->UseSSAOOn();
  scene.renderer->SetSSAORadius(1.0);
  const Picture occluded = scene.render();
  EXPECT_GT(differingPixels(plain, occluded, 20), 300u) << "there is occlusion to see";
  scene.useGnomon();
  const auto wrong = [&]
  {
    const Picture picture = scene.render();
    return countPixels(picture,
      [&](int x, int y)
      {
        const glm::dvec2 floor = scene.floorAt(x, y);
        const bool isUmbra = floor.x > 1.2 && floor.x < 2.8 && std::abs(floor.y) < 0.8;
        const int off = std::abs(picture.red(x, y) - occluded.red(x, y));
        return (isUmbra && picture.red(x, y) > 64) || (floor.x < -1.1 && off > 4);
      });
  };
  judge(scene, wrong);
}

/// A ground a hundred times as wide as the model, with lines drawn on it.
TEST_F(Wishes, gridReceives)
{
  SeenBox scene(standingBox, 100.0, 4.0);
  vtkPlaneSource::SafeDownCast(scene.floor()->GetMapper()->GetInputAlgorithm())
    ->SetResolution(100, 100);
  scene.floor()->GetProperty()->EdgeVisibilityOn();
  scene.floor()->GetProperty()->SetEdgeColor(1.0, 0.0, 0.0);
  const Picture plain = scene.renderPlain();
  const ExactFloor exact = [&](const glm::dvec2& floor)
  {
    const glm::dvec2 cell = glm::abs(floor / 2.0 - glm::round(floor / 2.0)) * 2.0;
    const bool isLine = std::min(cell.x, cell.y) < 0.1;
    return isLine ? -1.0 : floorUnderSun(standingBox, 100.0)(floor);
  };
  const auto wrong = [&]
  {
    const Picture picture = scene.render();
    const auto differs = [&](int x, int y) // including the lines, on the sun's side
    { return x < 60 && std::abs(picture.red(x, y) - plain.red(x, y)) > 2; };
    return checkFloor(scene, picture, exact, 0.3).wrong() + countPixels(picture, differs);
  };
  judge(scene, wrong, 2048);
}

/// World points in shadow: they lie in the box's shadow, and cover its area.
TEST_F(Wishes, coordinatesOfTheShadow)
{
  SeenBox scene(hangingBox, 10.0, 10.0);
  const VisibilityImages& kept = drawKept(scene, "raytraced");
  std::size_t dark = 0;
  for (std::size_t i = 0; i < kept.coverage.size(); ++i)
  {
    const glm::dvec3 position = positionOf(kept, i);
    if (kept.coverage[i] != 0.0f && position.z < 0.5 && kept.visibility[0][i] == 0.0f)
    {
      ++dark;
      EXPECT_TRUE(hitsBox(
        glm::dvec2(position), -slantingSun, hangingBox.lower - 1e-4, hangingBox.upper + 1e-4))
        << position.x << ' ' << position.y;
    }
  }
  const double pixelArea = 0.1 * 0.1;
  EXPECT_NEAR(static_cast<double>(dark) * pixelArea, 6.0, 0.1); // the box hides 2 of its 8
}

TEST_F(Wishes, headLess)
{
  if (!makeOffScreenWindow()->IsA("vtkGnomonEGLRenderWindow"))
  {
    GTEST_SKIP() << "VTK's own windows need a display";
  }
  unsetenv("DISPLAY");
  SeenBox scene(hangingBox, 10.0, 10.0, 100);
  EXPECT_EQ(scene.wrong(0.4), 0u);
}

} // namespace gnomon::test
