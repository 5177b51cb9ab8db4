// Shadows of translucent casters: what they let through, as VTK draws them.

#include "PassScene.h"

namespace gnomon::test
{
namespace
{

/// A lit floor that panes lie above, seen from above. The panes receive nothing and are black, so
/// that they add no light.
struct Glass : PassTest
{
  Glass()
  {
    this->scene.addFloor(8.0);
    this->sun = this->scene.addSun({ 0.0, 0.0, -1.0 });
    this->scene.lookDown(2.0);
    this->scene.pass->TranslucentCastersOn();
  }

  vtkActor* addPane(double z, double opacity, double extent = 4.0)
  {
    vtkActor* const actor = this->scene.addFloor(extent, z);
    actor->GetProperty()->SetOpacity(opacity);
    actor->GetProperty()->SetDiffuse(0.0);
    vtkGnomonPropKeys::SetReceives(actor, false);
    return actor;
  }
  /// Return the visibility of the middle of the picture.
  float middle(const char* text = "")
  {
    const VisibilityImages& kept = drawKept(this->scene, text);
    return kept.visibility[0][24 * 48 + 24];
  }
  std::string notes() { return testing::PrintToString(this->scene.report().notes); }

  PassScene scene{ 48, 48 };
  vtkLight* sun;
};

using TracedGlass = PassTestOf<const char*, Glass>;

TEST_P(TracedGlass, LeavesTheProductOfWhatPanesLetThrough)
{
  double expected = 1.0;
  double z = 1.0;
  for (const double opacity : { 0.5, 0.1, 0.3 })
  {
    this->addPane(z, opacity);
    z += 0.5;
    expected *= 1.0 - opacity;
    EXPECT_NEAR(this->middle(this->GetParam()), expected, 1e-6);
  }
  // An opaque box blocks all light.
  this->scene.addBox({ 0.5, -1.0, 3.0 }, { 1.5, 1.0, 3.2 });
  EXPECT_NEAR(this->middle(), expected, 1e-6);
  this->sun->SetFocalPoint(-1.0, 0.0, -3.0); // from above the box to the middle
  EXPECT_EQ(this->middle(), 0.0f);
}

INSTANTIATE_TEST_SUITE_P(, TracedGlass,
  testing::Values("raytraced", "silhouette", "crsm", "crsma", "selective", "coherence",
    "raytraced edge_samples=4", "auto"),
  [](const auto& technique)
  {
    std::string name = technique.param;
    std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
  });

TEST_F(Glass, AreaLightsLoseLightSampleBySample)
{
  this->scene.renderer->RemoveAllLights();
  vtkNew<vtkGnomonAreaLight> lamp;
  aim(lamp, { 0.0, 0.0, 8.0 });
  lamp->SetPositional(true);
  lamp->SetRadius(2.0);
  this->scene.renderer->AddLight(lamp);
  // The left half of the lamp's light passes a pane.
  vtkActor* const pane = this->addPane(4.0, 0.5);
  pane->SetPosition(-4.0, 0.0, 0.0);
  for (const char* const technique : { "raytraced", "penumbra" })
  {
    this->scene.choose(technique);
    this->scene.set("light_samples", 256);
    EXPECT_NEAR(this->middle(), 0.75, 0.02) << technique;
    vtkActor* const whole = this->addPane(2.0, 0.5);
    EXPECT_NEAR(this->middle(), 0.375, 0.01) << technique;
    // An opaque body takes the right half, as far as it does not hide the middle pixel.
    vtkActor* const body = this->scene.addFloor(4.0, 7.9);
    body->SetPosition(4.08, 0.0, 0.0);
    EXPECT_NEAR(this->middle(), 0.138, 0.01) << technique;
    this->scene.renderer->RemoveActor(whole);
    this->scene.renderer->RemoveActor(body);
  }
}

TEST_F(Glass, CastsOnlyIfAskedAndAsItsKeysSay)
{
  vtkActor* const pane = this->addPane(1.0, 0.25);
  EXPECT_NEAR(this->middle("raytraced"), 0.75, 1e-6);
  vtkGnomonPropKeys::SetTransmits(pane, vtkGnomonPropKeys::TRANSMITS_NOTHING);
  EXPECT_EQ(this->middle(), 0.0f);
  vtkGnomonPropKeys::SetTransmits(pane, vtkGnomonPropKeys::TRANSMITS_GREY);
  EXPECT_NEAR(this->middle(), 0.75, 1e-6);
  vtkGnomonPropKeys::SetCasts(pane, false);
  EXPECT_EQ(this->middle(), 1.0f);
  this->scene.pass->TranslucentCastersOff();
  vtkGnomonPropKeys::SetCasts(pane, true);
  EXPECT_NEAR(this->middle(), 0.75, 1e-6);
  pane->GetPropertyKeys()->Clear();
  EXPECT_EQ(this->middle(), 1.0f);
  EXPECT_THAT(this->notes(),
    testing::HasSubstr("casts nothing unless its key asks, or SetTranslucentCasters()"));
  vtkGnomonPropKeys::SetTransmits(pane, 7);
  EXPECT_THAT(this->takeErrors(), testing::HasSubstr("TRANSMITS was to be 7"));
}

TEST_F(Glass, ReceiversFollowItsChanges)
{
  vtkActor* const lower = this->addPane(0.5, 0.5);
  lower->GetProperty()->SetDiffuse(1.0);
  vtkActor* const upper = this->addPane(1.5, 0.4, 1.0);
  this->scene.choose("silhouette edge_samples=auto");
  this->scene.render();
  const std::size_t without = this->scene.report().bytesMaps;
  vtkGnomonPropKeys::SetReceives(lower, true);
  const auto expectLikeNew = [&](const char* change)
  {
    const Picture picture = this->scene.render();
    vtkNew<vtkGnomonShadowPass> pass;
    pass->SetTechnique("silhouette");
    pass->TranslucentCastersOn();
    this->scene.renderer->SetPass(pass);
    const Picture other = this->scene.render();
    EXPECT_TRUE(picture == other) << change;
    this->scene.useGnomon();
    return picture;
  };
  Picture last = expectLikeNew("none");
  const std::size_t map = this->scene.report().bytesMaps;
  EXPECT_GT(map, without + 512 * 400 * 32) << "half the light's map, 32 bytes a texel";
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "opacity", [&] { upper->GetProperty()->SetOpacity(0.7); } },
    { "place", [&] { upper->SetPosition(0.5, 0.2, 0.1); } },
    { "light", [&] { this->sun->SetPosition(-1.0, 0.5, 4.0); } },
    { "colour",
      [&]
      {
        vtkGnomonPropKeys::SetTransmits(upper, vtkGnomonPropKeys::TRANSMITS_COLORED);
        upper->GetProperty()->SetDiffuseColor(1.0, 0.2, 0.1);
      } },
    { "its end", [&] { upper->VisibilityOff(); } },
  };
  for (const auto& [name, change] : changes)
  {
    change();
    const Picture picture = expectLikeNew(name);
    EXPECT_GT(differingPixels(picture, last, 4), 20u) << name;
    last = picture;
  }
  this->scene.set("map_size", 512);
  this->scene.render();
  EXPECT_LT(this->scene.report().bytesMaps, map / 2);
}

TEST_F(Glass, TakesItsShareOfTheSky)
{
  aim(this->sun, { 0.0, 0.0, -1.0 }); // from below
  this->scene.pass->SetSkyIntensity(1.0);
  this->scene.pass->SetSkyDirections(64);
  EXPECT_EQ(this->scene.redAt(this->scene.render(), 0.0, 0.0), 255);
  this->addPane(0.02, 0.25); // nearly all rays to the sky cross it
  const double seen = 255.0 * 0.75;
  EXPECT_NEAR(this->scene.redAt(this->scene.render(), 0.0, 0.0), 0.75 * seen, 2.0);
}

TEST_F(Glass, SurfacesKeepTheirBytesBesideGlassThatCastsNothing)
{
  this->scene.addThings();
  this->scene.lookDown(4.0);
  vtkActor* const pane = this->addPane(3.0, 0.5, 0.5);
  pane->SetPosition(-2.5, 1.0, 0.0);
  this->scene.pass->TranslucentCastersOff();
  for (const char* const technique : { "raytraced", "silhouette", "crsm", "auto", "pcf" })
  {
    this->scene.choose(technique);
    pane->VisibilityOn();
    const Picture with = this->scene.render();
    pane->VisibilityOff();
    const Picture without = this->scene.render();
    const std::size_t changed = countPixels(with,
      [&](int x, int y)
      {
        const glm::dvec2 place = this->scene.floorAt(x, y) - glm::dvec2(-2.5, 1.0);
        return std::max(std::abs(place.x), std::abs(place.y)) > 0.6 &&
          with.at(x, y) != without.at(x, y);
      });
    EXPECT_EQ(changed, 0u) << technique;
  }
}

/// So do scenes without volumes.
TEST_F(Glass, ScenesWithoutItKeepTheirBytes)
{
  this->scene.addThings();
  for (const char* const technique : { "raytraced", "crsm", "pcf", "auto" })
  {
    this->scene.choose(technique);
    this->scene.pass->TranslucentCastersOff();
    this->scene.pass->VolumeCastersOff();
    const Picture without = this->scene.render();
    this->scene.pass->TranslucentCastersOn();
    this->scene.pass->VolumeCastersOn();
    EXPECT_TRUE(this->scene.render() == without) << technique;
  }
}

} // namespace
} // namespace gnomon::test
