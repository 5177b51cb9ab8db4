// Tiles that a wall hides take no rays. Picture, numbers and report are the same as with rays.

#include "BuiltinPass.h"
#include "PassScene.h"

namespace gnomon::test
{
namespace
{

constexpr int side = 200; // pixels

using Skipping = PassTest;

/// Return a light's visibility as the only light, with no earlier frame by that camera: all of it
/// is traced.
std::vector<float> traceAlone(const BuiltinPass& scene, const glm::dvec3& position, int index)
{
  for (int i = 0; i < scene.renderer->GetLights()->GetNumberOfItems(); ++i)
  {
    lightOf(scene.renderer, i)->SetSwitch(i == index);
  }
  for (const double lift : { 0.1, 0.0 })
  {
    scene.renderer->GetActiveCamera()->SetPosition(position.x, position.y + lift, position.z);
    scene.window->Render();
  }
  EXPECT_EQ(scene.pass->GetReport().lights[static_cast<std::size_t>(index)].tilesTraced, 0);
  return scene.pass->GetVisibility().visibility.at(0);
}

bool isLit(const std::vector<float>& visibility)
{
  return std::find(visibility.begin(), visibility.end(), 1.0f) != visibility.end();
}

} // namespace

TEST_F(Skipping, leavesEachLampOfABuildingAsItIs)
{
  const BuiltinPass all("building", side);
  const BuiltinPass alone("building", side);
  for (const BuiltinPass* scene : { &all, &alone })
  {
    scene->choose("raytraced");
    scene->pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
  }
  glm::dvec3 position;
  all.renderer->GetActiveCamera()->GetPosition(position.x, position.y, position.z);
  all.window->Render();
  const FrameReport& report = all.pass->GetReport();
  ASSERT_EQ(report.lights.size(), 64u);
  std::size_t withoutRays = 0;
  constexpr int tiles = 4 * 13;
  for (const LightReport& light : report.lights)
  {
    EXPECT_EQ(light.tilesLit + light.tilesDark + light.tilesTraced, tiles);
    EXPECT_EQ(light.rays == 0, light.tilesTraced == 0) << light.sceneIndex;
    EXPECT_EQ(light.skipReason, light.rays == 0 ? "casters hide it from all that is visible" : "");
    withoutRays += light.rays == 0 ? 1 : 0;
  }
  EXPECT_GT(withoutRays, 40u);
  int inSight = 0;
  for (int i = 0; i < 64; ++i)
  {
    const std::vector<float>& visibility =
      all.pass->GetVisibility().visibility[static_cast<std::size_t>(i)];
    if (i % 5 == 0 || isLit(visibility))
    {
      EXPECT_EQ(visibility, traceAlone(alone, position, i)) << i;
    }
    inSight += isLit(visibility) ? 1 : 0;
  }
  EXPECT_GE(inSight, 3);
}

namespace
{

/// A room with a partition, a crate in it, and lamps on both sides.
struct Rooms
{
  PassScene scene{ side, side };
  vtkActor* crate;

  Rooms()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -0.1, -4.0, 0.0 }, { 0.1, 4.0, 3.0 });
    this->crate = this->scene.addBox({ -2.0, -0.5, 0.0 }, { -1.0, 0.5, 1.5 });
    this->scene.lookFrom({ -3.5, -3.5, 6.0 }, { -2.0, 0.0, 0.0 });
    this->scene.choose({ "raytraced", vtkGnomonShadowPass::ROUTE_IMAGE });
  }
  void addLamp(int index)
  {
    const glm::dvec3 places[] = { { -3.0, 1.0, 2.0 }, { 2.0, 0.5, 2.0 }, { 2.0, -1.0, 6.0 } };
    this->scene.addSpot(places[index], { 0.0, 0.0, 0.0 }, allDirections);
  }
};

} // namespace

TEST_F(Skipping, followsCastersThatMove)
{
  Rooms all;
  for (int lamp = 0; lamp < 3; ++lamp)
  {
    all.addLamp(lamp);
  }
  int dark = 0;
  for (int step = 0; step < 5; ++step)
  {
    const glm::dvec3 place(0.4 * step, 0.3 * step, step == 4 ? 2.0 : 0.0);
    all.crate->SetPosition(place.x, place.y, place.z);
    const std::vector<std::vector<float>> visibility = drawKept(all.scene).visibility;
    for (int lamp = 0; lamp < 3; ++lamp)
    {
      const auto i = static_cast<std::size_t>(lamp);
      Rooms alone;
      alone.addLamp(lamp);
      alone.crate->SetPosition(place.x, place.y, place.z);
      EXPECT_EQ(visibility[i], drawKept(alone.scene).visibility[0]) << step << ", lamp " << lamp;
      dark += all.scene.report().lights[i].tilesDark;
      EXPECT_GT(
        all.scene.report().lights[i].tilesTraced + all.scene.report().lights[i].tilesDark, 0);
    }
  }
  EXPECT_GT(dark, 0);
}

} // namespace gnomon::test
