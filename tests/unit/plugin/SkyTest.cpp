// The light of a sky in pictures.

#include "PassScene.h"

namespace gnomon::test
{
namespace
{

/// A scene whose lights reach nothing, so that the sky alone is seen.
struct SkyTest : PassTest
{
  SkyTest() { this->scene.pass->SetSkyDirections(64); }

  vtkActor* addDarkFloor()
  {
    vtkActor* const floor = this->scene.addFloor(4.0);
    this->scene.addSun({ 0.0, 0.0, 1.0 }); // from below
    this->scene.lookDown(2.0);
    return floor;
  }
  int middle() { return this->scene.redAt(this->scene.render(), 0.0, 0.0); }

  PassScene scene{ 48, 48 };
};

TEST_F(SkyTest, OpenPlatesHaveTheirWholeColour)
{
  vtkActor* const floor = this->addDarkFloor();
  floor->GetProperty()->SetDiffuseColor(1.0, 0.5, 0.25);
  floor->GetProperty()->SetAmbientColor(1.0, 1.0, 1.0);
  EXPECT_EQ(this->middle(), 0);
  this->scene.pass->SetSkyIntensity(0.4);
  this->scene.pass->SetSkyColor(1.0, 1.0, 0.5);
  const Picture picture = this->scene.render();
  EXPECT_EQ(this->scene.redAt(picture, 0.0, 0.0), 102); // 0.4 of 255
  EXPECT_EQ(this->scene.redAt(picture, 1.5, -1.5), 102);
  floor->GetProperty()->SetAmbient(0.2);
  EXPECT_EQ(this->middle(), 153);
  for (const int model : { vtkGnomonShadowPass::SKY_DOME, vtkGnomonShadowPass::SKY_OVERCAST })
  {
    this->scene.pass->SetSkyModel(model);
    EXPECT_EQ(this->middle(), 153);
    this->scene.pass->SetSkyUp(0.0, 0.0, -1.0); // the ground is above
    EXPECT_EQ(this->middle(), 0);
    this->scene.pass->SetSkyUp(0.0, 0.0, 1.0);
  }
}

TEST_F(SkyTest, SettingsByNameAreThoseOfThePassAndMistakesChangeNone)
{
  vtkGnomonShadowPass& pass = *this->scene.pass;
  EXPECT_TRUE(pass.SetSetting("sky_intensity", 0.4) && pass.SetSetting("sky_model", "overcast") &&
    pass.SetSetting("sky_distance", "2.5") && pass.SetSetting("sky_directions", 1024));
  EXPECT_EQ(pass.GetSkyIntensity(), 0.4);
  EXPECT_EQ(pass.GetSkyModel(), vtkGnomonShadowPass::SKY_OVERCAST);
  EXPECT_EQ(pass.GetSkyDistance(), 2.5);
  EXPECT_EQ(pass.GetSkyDirections(), 1024);
  const vtkMTimeType before = pass.GetMTime();
  for (const auto& [name, value, expected] :
    { std::tuple("sky_intensity", "-1", "a number in [0, 1e+06]"),
      std::tuple("sky_intensity", "nan", "a number in [0, 1e+06]"),
      std::tuple("sky_model", "blue", "one of: uniform, dome, overcast"),
      std::tuple("sky_distance", "far", "a number of at least 0"),
      std::tuple("sky_directions", "100", "one of: 16, 32, 64"),
      std::tuple("sky", "1", "Lights have no setting 'sky'") })
  {
    const std::string was = pass.GetSetting(name);
    EXPECT_FALSE(pass.SetSetting(name, value));
    EXPECT_THAT(this->takeErrors(), testing::HasSubstr(expected));
    EXPECT_THAT(pass.GetSettingError(), testing::HasSubstr(expected));
    EXPECT_EQ(pass.GetSetting(name), was);
  }
  const double nan = std::nan("");
  for (const std::function<void()>& set :
    std::initializer_list<std::function<void()>>{ [&] { pass.SetSkyIntensity(-0.1); },
      [&] { pass.SetSkyIntensity(nan); }, [&] { pass.SetSkyIntensity(1e300); },
      [&] { pass.SetSkyColor(0.5, -0.1, 0.5); }, [&] { pass.SetSkyColor(nan, 0.5, 0.5); },
      [&] { pass.SetSkyUp(0.0, 0.0, 0.0); }, [&] { pass.SetSkyUp(0.0, nan, 1.0); },
      [&] { pass.SetSkyDistance(-1.0); }, [&] { pass.SetSkyDirections(100); } })
  {
    set();
    EXPECT_THAT(this->takeErrors(), testing::HasSubstr("Sky"));
  }
  EXPECT_EQ(pass.GetMTime(), before);
  EXPECT_EQ(pass.GetSetting("sky_directions"), "1024");
  EXPECT_TRUE(pass.SetSetting("sky_directions", "64"));
  EXPECT_EQ(pass.GetSettingError(), "");
}

/// Physically based materials are shown after VTK's gamma.
TEST_F(SkyTest, PhysicallyBasedMaterialsHaveTheirDiffuseColour)
{
  vtkActor* const floor = this->addDarkFloor();
  floor->GetProperty()->SetInterpolationToPBR();
  floor->GetProperty()->SetRoughness(1.0);
  floor->GetProperty()->SetColor(0.5, 0.5, 0.5);
  this->scene.pass->SetSkyIntensity(0.8);
  EXPECT_NEAR(this->middle(), 255.0 * std::pow(0.4, 1.0 / 2.2), 1.0);
  floor->GetProperty()->SetMetallic(1.0);
  EXPECT_EQ(this->middle(), 0);
}

TEST_F(SkyTest, ClosedBoxesAreDarkInside)
{
  this->scene.addBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 })->GetProperty()->SetAmbient(0.5);
  this->scene.addSun({ 0.0, 0.0, 1.0 });
  this->scene.lookFrom({ 0.5, 0.4, 0.6 }, { -1.0, -0.5, -1.0 });
  this->scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 10.0);
  this->scene.pass->SetSkyIntensity(0.5);
  for (const unsigned char value : this->scene.render().rgb)
  {
    EXPECT_EQ(value, 0);
  }
  this->scene.pass->SetSkyDistance(1e-3); // the room's walls are farther off
  EXPECT_GT(this->scene.render().rgb[0], 100);
}

/// Beside a wall of height H, (1 + cos(atan(H / d))) / 2 of the sky is left at distance d.
TEST_F(SkyTest, WallsDarkenTheGroundBesideThem)
{
  this->addDarkFloor();
  this->scene.addBox({ -1000.0, 0.5, 0.0 }, { 1000.0, 0.6, 1.0 });
  this->scene.pass->SetSkyDirections(1024);
  this->scene.pass->SetSkyIntensity(1.0);
  const Picture picture = this->scene.render();
  for (int row = 0; this->scene.floorAt(20, row).y < 0.45; ++row)
  {
    const double distance = 0.5 - this->scene.floorAt(20, row).y;
    const double expected = 0.5 * (1.0 + std::cos(std::atan2(1.0, distance)));
    EXPECT_NEAR(picture.red(20, row), 255.0 * expected, 2.0) << distance;
  }
}

/// Unlit surfaces, highlights and metals have the same bytes with a sky.
TEST_F(SkyTest, OnlyDiffuseAndAmbientTermsChange)
{
  const std::pair<const char*, std::function<void(vtkProperty*)>> kinds[] = {
    { "unlit", [](vtkProperty* look) { look->LightingOff(); } },
    { "unlit tubes",
      [](vtkProperty* look)
      {
        look->LightingOff();
        look->SetRepresentationToWireframe();
        look->RenderLinesAsTubesOn();
        look->SetLineWidth(3.0);
      } },
    { "highlights alone",
      [](vtkProperty* look)
      {
        look->SetDiffuseColor(0.0, 0.0, 0.0);
        look->SetSpecular(0.8);
        look->SetSpecularPower(5.0);
      } },
    { "a metal",
      [](vtkProperty* look)
      {
        look->SetInterpolationToPBR();
        look->SetMetallic(1.0);
        look->SetRoughness(0.4);
      } },
  };
  for (const auto& [name, make] : kinds)
  {
    PassScene of(40, 40);
    make(of.addSphere({ 0.0, 0.0, 0.0 }, 1.0)->GetProperty());
    of.addSun({ -1.0, -0.5, -2.0 });
    of.lookFrom({ 2.0, 1.0, 4.0 });
    of.choose(tracedWay);
    const Picture before = of.render();
    of.pass->SetSkyIntensity(0.5);
    EXPECT_EQ(of.render().rgb, before.rgb) << name;
  }
}

/// The edges of a mesh are drawn on its surface, unlit.
TEST_F(SkyTest, DrawnEdgesKeepTheirColour)
{
  vtkActor* const floor = this->addDarkFloor();
  this->scene.addBox({ 4.3, -9.0, 0.0 }, { 4.4, 9.0, 9.0 }); // hides half of the sky
  this->scene.lookDown(4.5);
  floor->GetProperty()->EdgeVisibilityOn();
  floor->GetProperty()->SetEdgeColor(0.0, 1.0, 0.0);
  floor->GetProperty()->SetLineWidth(6.0);
  const auto onEdge = [this] { return this->scene.render().at(44, 24); };
  ASSERT_EQ(onEdge(), glm::ivec3(0, 255, 0));
  this->scene.pass->SetSkyIntensity(0.4);
  EXPECT_EQ(onEdge(), glm::ivec3(0, 255, 0));
  EXPECT_LT(this->middle(), 102);
}

TEST_F(SkyTest, AnotherLayerIsNoReasonToTrace)
{
  this->scene.addThings();
  this->scene.addSun({ -1.0, -0.4, -1.5 });
  this->scene.choose(tracedWay);
  this->scene.pass->SetSkyIntensity(0.5);
  this->scene.render();
  this->scene.set("light_radius", "5"); // takes a layer instead of a bit
  const Picture moved = this->scene.render();
  const std::vector<ValueReport>& values = this->scene.report().values;
  const auto sky = std::find_if(values.begin(), values.end(),
    [](const ValueReport& value) { return value.name == "the view of the sky"; });
  ASSERT_NE(sky, values.end());
  EXPECT_TRUE(sky->reused) << sky->changes;
  EXPECT_EQ(this->scene.report().skyProgress, 1.0);
  this->scene.pass->SetSkyDirections(32);
  this->scene.render();
  this->scene.pass->SetSkyDirections(64); // traces
  EXPECT_EQ(this->scene.render().rgb, moved.rgb);
}

TEST_F(SkyTest, LightsKeepTheirShadows)
{
  this->scene.addThings();
  this->scene.addSun({ -1.0, -0.4, -1.5 });
  for (const Way& way : { tracedWay, Way{ "nsm", vtkGnomonShadowPass::ROUTE_AUTO },
         Way{ "silhouette", vtkGnomonShadowPass::ROUTE_AUTO }, layersWay })
  {
    this->scene.choose(way);
    this->scene.pass->KeepVisibilityOn();
    this->scene.pass->SetSkyIntensity(0.0);
    const std::vector<float> before = drawKept(this->scene).visibility.at(0);
    this->scene.pass->SetSkyIntensity(0.5);
    EXPECT_EQ(drawKept(this->scene).visibility.at(0), before) << way.technique;
    EXPECT_EQ(this->scene.report().route, "image");
  }
}

TEST_F(SkyTest, PropsThatShowNoShadowsHaveAllOfIt)
{
  vtkActor* const floor = this->addDarkFloor();
  this->scene.addBox({ -4.0, -4.0, 0.5 }, { 4.0, 4.0, 0.6 });
  this->scene.renderer->GetActiveCamera()->SetClippingRange(0.001, 100.0);
  this->scene.lookFrom({ 0.0, 0.1, 0.3 }, { 0.0, 0.0, 0.0 });
  this->scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 10.0);
  this->scene.pass->SetSkyIntensity(0.4);
  EXPECT_LT(this->scene.render().rgb[0], 20);
  vtkGnomonPropKeys::SetReceives(floor, false);
  EXPECT_EQ(this->scene.render().rgb[0], 102);
}

TEST_F(SkyTest, StaleViewsAreTracedAgain)
{
  this->addDarkFloor();
  vtkActor* const roof = this->scene.addFloor(1.0, 0.5);
  vtkGnomonPropKeys::SetReceives(roof, false);
  this->scene.pass->SetSkyIntensity(0.5);
  this->scene.render();
  const auto rays = [this]
  {
    this->scene.render();
    return this->scene.report().raysTraced;
  };
  EXPECT_EQ(rays(), 0);
  this->scene.pass->SetSkyColor(0.5, 0.5, 1.0);
  this->scene.pass->SetSkyIntensity(0.7);
  EXPECT_EQ(rays(), 0) << "they decide nothing of what is hidden";
  const std::vector<std::function<void()>> changes = {
    [&] { roof->SetPosition(0.3, 0.0, 0.0); },
    [&] { this->scene.renderer->GetActiveCamera()->Roll(10.0); },
    [&] { this->scene.pass->SetSkyModel(vtkGnomonShadowPass::SKY_OVERCAST); },
    [&] { this->scene.pass->SetSkyUp(0.0, 1.0, 1.0); },
    [&] { this->scene.pass->SetSkyDistance(2.0); },
    [&] { this->scene.pass->SetSkyDirections(16); },
    [&] { roof->VisibilityOff(); },
  };
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    changes[i]();
    EXPECT_GT(rays(), 1000) << i;
    EXPECT_EQ(rays(), 0) << i;
  }
}

TEST_F(SkyTest, MovingPicturesHaveFewDirections)
{
  PassScene large(320, 320);
  large.addThings();
  large.addSun({ 0.0, 0.0, 1.0 }); // from below
  large.choose(tracedWay);
  large.pass->SetSkyIntensity(1.0);
  const Picture rests = large.render();
  EXPECT_EQ(large.report().skyProgress, 1.0);
  large.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_ON);
  large.renderer->GetActiveCamera()->Roll(1e-9); // the same picture
  const Picture moves = large.render();
  EXPECT_EQ(large.report().skyProgress, 0.0);
  EXPECT_LT(large.report().raysTraced, 3 * 320 * 320);
  const auto black = std::count(rests.rgb.begin(), rests.rgb.end(), 0);
  const double seen = static_cast<double>(rests.rgb.size() - black);
  EXPECT_LT(rmsDifference(rests, moves) * std::sqrt(rests.rgb.size() / seen), 0.03 * 255.0);
  large.pass->SetInteractive(vtkGnomonShadowPass::INTERACTIVE_OFF);
  EXPECT_EQ(large.render().rgb, rests.rgb);
}

} // namespace
} // namespace gnomon::test
