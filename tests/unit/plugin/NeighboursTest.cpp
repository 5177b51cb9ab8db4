// Other parts of a VTK application must not be affected by the pass: picking, translucent
// and overlay props, and the renderer's own settings.

#include "PassScene.h"

#include <vtkWorldPointPicker.h>

using namespace gnomon::test;

namespace
{

struct Neighbours : PassTestOf<Way>
{
  Neighbours()
  {
    this->scene.choose(GetParam());
    this->scene.renderer->SetBackground(0.1, 0.2, 0.3);
  }

  SphereUnderSun scene{ 200, 150 };
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

/// VTK shades coarse spheres by their corners' normals. Facets that are turned away from the light
/// may then be bright. If the sphere casts nothing, nothing hides the light.
TEST_P(Neighbours, translucentFacetsAreDarkOnlyWhereTheLightIsHidden)
{
  this->scene.floor()->VisibilityOff();
  this->scene.sphere->VisibilityOff();
  vtkActor* const actor = this->scene.add(ballOf({ 0.0, 0.0, 1.5 }, 1.5)); // of 8 by 8 facets
  actor->GetProperty()->SetOpacity(0.5);
  vtkLight* const spot = this->scene.addSpot({ -4.0, -1.2, 7.5 }, { 0.0, 0.0, 1.5 }, 60.0);
  for (const bool isSun : { false, true })
  {
    this->scene.sun->SetSwitch(isSun);
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
  this->scene.sun->SetIntensity(0.0);
  EXPECT_EQ(differingPixels(this->scene.render(), hidden, 2), 0u);
}

/// Where no shadow is near, the picture is VTK's, with panes that only peeling sorts.
TEST_P(Neighbours, additionsOfTheRendererAreHonoured)
{
  for (const double slope : { 1.0, -1.0 })
  {
    vtkActor* actor = this->scene.add(
      planeOf({ -1.5, -1.5, 1.0 - slope }, { 1.5, -1.5, 1.0 + slope }, { -1.5, 1.5, 1.0 - slope }));
    actor->GetProperty()->SetOpacity(0.6);
    actor->GetProperty()->SetColor(slope > 0.0 ? 1.0 : 0.0, 0.0, slope > 0.0 ? 0.0 : 1.0);
  }
  vtkRenderer* const renderer = this->scene.renderer;
  const Picture plain = this->scene.renderPlain();
  const Picture shadowed = this->scene.render();
  const auto isLit = [&](int x, int y) { return plain.at(x, y) == shadowed.at(x, y); };
  for (const auto& [name, set] :
    { std::pair("FXAA", std::function<void(bool)>([=](bool on) { renderer->SetUseFXAA(on); })),
      { "peeling", [=](bool on) { renderer->SetUseDepthPeeling(on); } },
      { "occlusion", [=](bool on) { renderer->SetUseSSAO(on); } } })
  {
    SCOPED_TRACE(name);
    set(true);
    const Picture expected = this->scene.renderPlain();
    const Picture picture = this->scene.render();
    set(false);
    EXPECT_GT(differingPixels(plain, expected), 50u);
    EXPECT_GT(differingPixels(picture, expected, 20), 300u) << "shadows";
    const std::size_t wrong = countPixels(picture,
      [&](int x, int y)
      {
        const glm::ivec3 off = glm::abs(picture.at(x, y) - expected.at(x, y));
        return std::max({ off.r, off.g, off.b }) > 4 && holdsAround({ 200, 150 }, x, y, 3, isLit);
      });
    EXPECT_EQ(wrong, 0u);
  }
}

TEST_P(Neighbours, renderedPropsAreCounted)
{
  this->scene.renderPlain();
  const int plain = this->scene.renderer->GetNumberOfPropsRendered();
  this->scene.render();
  EXPECT_EQ(this->scene.renderer->GetNumberOfPropsRendered(), plain);
  EXPECT_EQ(this->scene.pass->GetNumberOfRenderedProps(), plain);
}
