// Other parts of a VTK application must not be affected by the pass: picking, translucent
// and overlay props, and the renderer's own settings.

#include "PassScene.h"

#include <vtkWorldPointPicker.h>

using namespace gnomon::test;

namespace
{

class Neighbours : public PassTestOf<Way>
{
protected:
  Neighbours()
  {
    this->scene.choose(GetParam());
    this->scene.renderer->SetBackground(0.1, 0.2, 0.3);
    this->sphere = this->scene.addSphereOverFloor();
    this->sun = this->scene.addSun({ 1.0, 0.3, -1.5 });
  }

  void expectPlainWhereNothingCasts()
  {
    this->sun->SetShadowAttenuation(0.0f);
    const Picture idle = this->scene.render();
    EXPECT_EQ(differingPixels(idle, this->scene.renderPlain()), 0u);
  }

  PassScene scene{ 200, 150 };
  vtkActor* sphere;
  vtkLight* sun;
};

INSTANTIATE_TEST_SUITE_P(Ways, Neighbours, allWays, nameOf);

} // namespace

TEST_P(Neighbours, worldPointPickerGivesTheSamePoints)
{
  vtkNew<vtkWorldPointPicker> picker;
  const auto pick = [&](double x, double y)
  {
    this->scene.render();
    picker->Pick(x, y, 0.0, this->scene.renderer);
    const double* point = picker->GetPickPosition();
    return glm::dvec3(point[0], point[1], point[2]);
  };
  for (const glm::ivec2& pixel :
    { glm::ivec2(100, 105), { 100, 40 }, { 30, 60 }, { 150, 80 }, { 125, 75 }, { 1, 148 } })
  {
    this->scene.usePlain();
    const glm::dvec3 plain = pick(pixel.x, pixel.y);
    this->scene.useGnomon();
    const glm::dvec3 gnomon = pick(pixel.x, pixel.y);
    EXPECT_EQ(plain, gnomon) << pixel.x << ", " << pixel.y;
  }
  EXPECT_NEAR(pick(100, 40).z, 0.0, 0.05) << "the floor";
}

TEST_P(Neighbours, translucentPropsKeepTheirColoursAndShowShadows)
{
  // A pane in front of a shadow, and half in the sphere's shadow itself.
  vtkActor* actor =
    this->scene.add(planeOf({ 0.6, -1.0, 0.6 }, { 1.6, -1.0, 0.6 }, { 0.6, 1.0, 0.6 }));
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  actor->GetProperty()->SetOpacity(0.5);
  for (const bool peeling : { false, true })
  {
    this->scene.renderer->SetUseDepthPeeling(peeling);
    // The picture behind the pane, and the picture with it.
    const auto draw = [&](float attenuation)
    {
      this->sun->SetShadowAttenuation(attenuation);
      actor->VisibilityOff();
      const Picture behind = this->scene.render();
      actor->VisibilityOn();
      return std::make_pair(behind, this->scene.render());
    };
    const auto [behind, both] = draw(1.0f);
    const auto [behindIdle, bothIdle] = draw(0.0f);
    // The reference is the shader's result at the pane. Every way of a pointwise technique must
    // show the same. Others use a map of their own there, which is filtered.
    const gnomon::TechniqueInfo& info =
      gnomon::findTechnique(GetParam().technique)->estimator->info;
    this->scene.choose(
      { info.isPointwise() ? GetParam().technique : "pcf", vtkGnomonShadowPass::ROUTE_INLINE });
    const auto [behindInline, bothInline] = draw(1.0f);
    this->scene.choose(GetParam());
    std::size_t panePixels = 0;
    std::size_t overShadow = 0;
    std::size_t dark = 0;
    std::size_t different = 0;
    for (int y = 0; y < both.height; ++y)
    {
      for (int x = 0; x < both.width; ++x)
      {
        // The red pane hides half of the green behind it.
        if (bothIdle.at(x, y).g < 0.6 * behindIdle.at(x, y).g)
        {
          const double own = both.red(x, y) - 0.5 * behind.red(x, y);
          const double ownIdle = bothIdle.red(x, y) - 0.5 * behindIdle.red(x, y);
          const double ownInline = bothInline.red(x, y) - 0.5 * behindInline.red(x, y);
          ++panePixels;
          different += info.isPointwise() && std::abs(own - ownInline) > 2.0 ? 1 : 0;
          overShadow += behind.red(x, y) != behindIdle.red(x, y) ? 1 : 0;
          dark += std::abs(own) <= 2.0 ? 1 : 0;
          const bool filters = !info.isPointwise() || info.has(gnomon::kernelSettings());
          const bool between = filters && own > -2.0 && own < ownIdle + 2.0;
          different += std::abs(own) > 2.0 && std::abs(own - ownIdle) > 2.0 && !between ? 1 : 0;
        }
      }
    }
    EXPECT_GT(panePixels, 500u);
    EXPECT_GT(overShadow, 50u);
    EXPECT_EQ(different, 0u) << "depth peeling: " << peeling;
    EXPECT_GT(dark, 100u) << "depth peeling: " << peeling;
    EXPECT_LT(dark, panePixels - 100u) << "depth peeling: " << peeling;
  }
  this->sun->SetShadowAttenuation(1.0f);
  this->scene.renderer->UseDepthPeelingOff(); // with it, VTK builds shaders in every frame
  this->scene.render();
  this->scene.render();
  const bool isPlain = std::string(GetParam().technique) == "raytraced";
  EXPECT_EQ(this->scene.report().notes.size(), isPlain ? 2u : 1u) << "one of what casts nothing";
  EXPECT_EQ(this->scene.report().programCompiles, 0);
  EXPECT_EQ(this->scene.report().mapBakes, 0);
}

/// VTK shades coarse spheres by their corners' normals. Facets that are turned away from the light
/// may then be bright. If the sphere casts nothing, nothing hides the light.
TEST_P(Neighbours, translucentFacetsAreDarkOnlyWhereTheLightIsHidden)
{
  this->scene.floor()->VisibilityOff();
  this->sphere->VisibilityOff();
  vtkActor* const actor = this->scene.add(ballOf({ 0.0, 0.0, 1.5 }, 1.5)); // of 8 by 8 facets
  actor->GetProperty()->SetOpacity(0.5);
  vtkLight* const spot = this->scene.addSpot({ -4.0, -1.2, 7.5 }, { 0.0, 0.0, 1.5 }, 60.0);
  for (const bool isSun : { false, true })
  {
    this->sun->SetSwitch(isSun);
    spot->SetSwitch(!isSun);
    const Picture plain = this->scene.renderPlain();
    EXPECT_EQ(differingPixels(this->scene.render(), plain, 2), 0u) << "sun: " << isSun;
    EXPECT_NE(this->scene.report().route, "none");

    vtkGnomonPropKeys::SetCasts(actor, true); // its facets hide their own light
    vtkGnomonPropKeys::SetTransmits(actor, vtkGnomonPropKeys::TRANSMITS_NOTHING);
    EXPECT_GT(differingPixels(this->scene.render(), plain, 2), 20u) << "sun: " << isSun;
    vtkGnomonPropKeys::SetCasts(actor, false);
    EXPECT_EQ(differingPixels(this->scene.render(), plain, 2), 0u) << "sun: " << isSun;
  }

  this->scene.addBox({ -12.0, -6.4, 13.4 }, { -4.0, 1.6, 13.6 }); // out of view
  const Picture hidden = this->scene.render();
  this->sun->SetIntensity(0.0);
  EXPECT_EQ(differingPixels(this->scene.render(), hidden, 2), 0u);
}

TEST_P(Neighbours, fxaaIsHonoured)
{
  const Picture without = this->scene.render();
  this->scene.renderer->UseFXAAOn();
  const Picture with = this->scene.render();
  EXPECT_GT(differingPixels(without, with), 50u);
  // Inside a shadow the colour stays black.
  EXPECT_EQ(with.red(100, 3), without.red(100, 3));
  this->expectPlainWhereNothingCasts();
}

TEST_P(Neighbours, depthPeelingIsHonoured)
{
  // Two panes that pierce each other: only peeling sorts them.
  for (const double slope : { 1.0, -1.0 })
  {
    vtkActor* actor = this->scene.add(
      planeOf({ -1.5, -1.5, 1.0 - slope }, { 1.5, -1.5, 1.0 + slope }, { -1.5, 1.5, 1.0 - slope }));
    actor->GetProperty()->SetOpacity(0.6);
    actor->GetProperty()->SetColor(slope > 0.0 ? 1.0 : 0.0, 0.0, slope > 0.0 ? 0.0 : 1.0);
  }
  const Picture unsorted = this->scene.render();
  this->scene.renderer->UseDepthPeelingOn();
  const Picture peeled = this->scene.render();
  EXPECT_GT(differingPixels(unsorted, peeled, 20), 500u);
  EXPECT_TRUE(this->scene.renderer->GetLastRenderingUsedDepthPeeling());
  this->expectPlainWhereNothingCasts();
}

TEST_P(Neighbours, renderedPropsAreCounted)
{
  this->scene.renderPlain();
  const int plain = this->scene.renderer->GetNumberOfPropsRendered();
  this->scene.render();
  EXPECT_EQ(this->scene.renderer->GetNumberOfPropsRendered(), plain);
  EXPECT_EQ(this->scene.pass->GetNumberOfRenderedProps(), plain);
}
