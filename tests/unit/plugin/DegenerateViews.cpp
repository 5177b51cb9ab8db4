#include "DegenerateViews.h"

namespace gnomon::test
{

//------------------------------------------------------------------------------
void drawDegenerateViews(const std::vector<double>& conesDegrees, const Choose& choose,
  const std::function<void(PassScene&)>& draw)
{
  PassScene scene(64, 48);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  for (const glm::dvec3& direction : { glm::dvec3(0.0, -1.0, 0.0), { 0.0, 1.0, 0.0 },
         { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 0.0, 0.0, -1.0 } })
  {
    scene.renderer->RemoveAllLights();
    choose(scene, scene.addSun(direction));
    draw(scene);
  }
  for (const glm::dvec3& position : { glm::dvec3(0.0, 0.0, 1.5), { 0.0, 0.0, -1.0 },
         { 0.0, 0.0, 0.0 }, { 0.7, 0.0, 1.5 }, { 0.0, 0.0, 50.0 } })
  {
    for (const double cone : conesDegrees)
    {
      scene.renderer->RemoveAllLights();
      choose(scene, scene.addSpot(position, { 0.1, 0.2, -3.0 }, cone));
      draw(scene);
    }
  }
}

//------------------------------------------------------------------------------
void drawByBothRoutes(PassScene& scene)
{
  drawKept(scene);
  scene.pass->KeepVisibilityOff();
  scene.render();
  EXPECT_EQ(scene.report().route, "inline");
}

} // namespace gnomon::test
