// The views that are hardest to fit, by every technique. Visibility is finite and in [0, 1], OpenGL
// reports no error, and the inline route draws them, too.

#include "PassScene.h"
#include "Variant.h"

using namespace gnomon::test;

namespace
{

struct DegenerateScenes : PassTestOf<Variant>
{
  static void fill(PassScene& scene)
  {
    scene.addSphereOverFloor();
    scene.addBox({ 1.0, 1.0, 0.0 }, { 2.0, 2.0, 1.0 });
  }

  static void draw(PassScene& scene)
  {
    drawKept(scene); // checks that numbers are finite and in [0, 1]
    scene.pass->KeepVisibilityOff();
    const bool isPointwise = GetParam().info().isPointwise();
    scene.pass->SetRoute(
      isPointwise ? vtkGnomonShadowPass::ROUTE_INLINE : vtkGnomonShadowPass::ROUTE_AUTO);
    scene.render();
    EXPECT_EQ(scene.report().route == "inline", isPointwise);
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_AUTO);
  }

  /// The widest cone that has a single view, and a light that sees all around.
  static std::vector<double> cones()
  {
    return GetParam().takesCubes() ? std::vector<double>{ 0.1, 45.0, 89.0, allDirections }
                                   : std::vector<double>{ 0.1, 45.0, 60.0 };
  }

  /// Two map sizes take turns; the smaller one is smaller than some kernels.
  void drawByTurns(PassScene& scene)
  {
    this->isSmall_ = !this->isSmall_;
    GetParam().set(scene.pass, "map_size", this->isSmall_ ? "16" : "256");
    draw(scene);
  }

  bool isSmall_ = false;
};

} // namespace

/// Along the axes, in the floor's plane and nearly in it.
TEST_BY_VARIANTS(DegenerateScenes, UnderAnySun, isForAll)
{
  PassScene scene(64, 48);
  this->fill(scene);
  GetParam().choose(scene);
  vtkLight* const sun = scene.addSun({ 0.0, 0.0, -1.0 });
  for (const glm::dvec3& toLight : { glm::dvec3(0.0, 1.0, 0.0), { 0.0, -1.0, 0.0 },
         { -1.0, 0.0, 0.0 }, { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 1.0 }, { -1.0, 0.0, 1e-5 } })
  {
    sun->SetPosition(toLight.x, toLight.y, toLight.z);
    this->drawByTurns(scene);
  }
}

/// Inside a caster; below it; on surfaces and on a corner; at the camera; far away.
TEST_BY_VARIANTS(DegenerateScenes, UnderAnyLamp, isForAll)
{
  PassScene scene(64, 48);
  this->fill(scene);
  GetParam().choose(scene);
  vtkLight* const lamp = scene.addSpot(glm::dvec3(0.0), { 0.1, 0.2, -3.0 }, 45.0);
  for (const glm::dvec3& place : { glm::dvec3(0.0, 0.0, 1.5), { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.0 },
         { 0.7, 0.0, 1.5 }, { 4.0, 4.0, 0.0 }, { 0.0, -9.0, 7.0 }, { 1e6, 0.0, 1e6 } })
  {
    lamp->SetPosition(place.x, place.y, place.z);
    for (const double cone : this->cones())
    {
      lamp->SetConeAngle(cone);
      this->drawByTurns(scene);
    }
  }
}

/// Cameras that see nothing at all, away from everything, inside a caster, and in the floor's
/// plane. From below, no receiver faces the light. They do not affect later frames.
TEST_BY_VARIANTS(DegenerateScenes, SeenFromAnywhere, isForAll)
{
  PassScene scene(64, 48);
  GetParam().choose(scene);
  const std::function<void()> lights[] = { [&] {
                                            scene.addSun({ 1.0, 0.4, -1.5 });
                                          },
    [&]
    {
      const double up[3] = { 0.0, 1.0, 0.0 };
      vtkGnomonLightKeys::SetBox(scene.addSun({ 2.0, 0.8, -3.0 }), 12.0, 12.0, 20.0, up);
    },
    [&] {
      scene.addSpot({ -2.0, -0.8, 6.0 }, glm::dvec3(0.0), this->cones().back());
    } };
  const std::pair<glm::dvec3, glm::dvec3> views[] = { { { 0.0, -9.0, 7.0 }, { 0.0, -20.0, 20.0 } },
    { { 0.0, 0.0, 1.5 }, { 1.0, 1.0, 0.0 } }, { { 0.0, -9.0, 0.0 }, glm::dvec3(0.0) },
    { { 0.0, -4.0, -4.0 }, glm::dvec3(0.0) } };
  for (const auto& addLight : lights)
  {
    scene.renderer->RemoveAllLights();
    scene.renderer->RemoveAllViewProps();
    addLight();
    draw(scene);
    this->fill(scene);
    const Picture first = scene.render();
    for (const auto& [eye, target] : views)
    {
      scene.lookFrom(eye, target);
      draw(scene);
    }
    scene.lookFrom({ 0.0, -9.0, 7.0 });
    EXPECT_EQ(differingPixels(scene.render(), first), 0u);
  }
}
