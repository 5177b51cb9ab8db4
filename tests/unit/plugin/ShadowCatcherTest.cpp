// Props that show nothing but shadows.

#include "PassScene.h"

#include <vtkAssembly.h>
#include <vtkUnsignedCharArray.h>

namespace gnomon::test
{
namespace
{

/// A floor over a page, with a shadow.
struct ShadowCatcherTest : PassTestOf<Way>
{
  ShadowCatcherTest()
  {
    this->scene.renderer->SetBackground(1.0, 1.0, 1.0);
    this->box = this->scene.addBox({ -1.0, -1.0, 1.0 }, { 1.0, 1.0, 3.0 });
    this->sun = this->scene.addSun(slantingSun);
    this->scene.lookDown(6.0);
    this->scene.choose(GetParam());
  }

  /// Compare the catcher over a white page with the share of the floor's light that arrives.
  void expectShareOfLight(double gamma = 1.0)
  {
    const Picture shadowed = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->box, false);
    const Picture lit = this->scene.render();
    vtkGnomonPropKeys::SetCasts(this->box, true);
    vtkGnomonPropKeys::SetShadowCatcher(this->floor, true);
    const Picture caught = this->scene.render();
    vtkGnomonPropKeys::SetShadowCatcher(this->floor, false);
    std::size_t dark = 0;
    for (int y = 0; y < shadowed.height; ++y)
    {
      for (int x = 0; x < shadowed.width; ++x)
      {
        const bool isFloor = !isUnder(this->scene.floorAt(x, y), hangingBox);
        const double share = static_cast<double>(shadowed.red(x, y)) / lit.red(x, y);
        ASSERT_NEAR(caught.red(x, y), isFloor ? 255.0 * std::pow(share, gamma) : shadowed.red(x, y),
          isFloor ? 3.0 : 0.0)
          << x << ", " << y;
        dark += caught.red(x, y) < 230 ? 1 : 0;
      }
    }
    EXPECT_GT(dark, 150u);
  }

  PassScene scene{ 64, 64 };
  vtkActor* floor = this->scene.addFloor(20.0);
  vtkActor* box = nullptr;
  vtkLight* sun = nullptr;
};

TEST_P(ShadowCatcherTest, TheirOpacityIsTheShareOfHiddenLight)
{
  vtkProperty* const material = this->floor->GetProperty();
  for (const double sky : { 0.0, 0.4 })
  {
    SCOPED_TRACE("sky " + std::to_string(sky));
    this->scene.pass->SetSkyIntensity(sky);
    material->SetAmbient(0.0);
    material->SetDiffuse(0.8);
    this->expectShareOfLight();
    material->SetAmbient(0.3);
    material->SetDiffuse(0.5);
    this->expectShareOfLight();
  }
  this->scene.pass->SetSkyIntensity(0.0);
  material->SetInterpolationToPBR();
  material->SetRoughness(1.0);
  this->expectShareOfLight(2.2);
}

TEST_P(ShadowCatcherTest, SeveralLightsShareTheOpacity)
{
  this->scene.addSun({ -1.0, 0.5, -1.0 })->SetIntensity(0.3);
  this->floor->GetProperty()->SetDiffuse(0.7);
  this->expectShareOfLight();
  this->sun->SetShadowAttenuation(0.5);
  this->expectShareOfLight();
}

INSTANTIATE_TEST_SUITE_P(Ways, ShadowCatcherTest,
  testing::Values(Way{ "nsm", vtkGnomonShadowPass::ROUTE_AUTO },
    Way{ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE },
    Way{ "raytraced", vtkGnomonShadowPass::ROUTE_AUTO },
    Way{ "penumbra light_radius=0.3", vtkGnomonShadowPass::ROUTE_AUTO }),
  [](const auto& way) { return "Number" + std::to_string(way.index); });

struct CaughtShadowsTest : PassTest
{
  CaughtShadowsTest()
  {
    vtkGnomonPropKeys::SetShadowCatcher(this->scene.floor(), true);
    this->scene.lookDown(6.0);
  }

  BoxScene scene{ 64, 64 };
};

TEST_F(CaughtShadowsTest, PicturesWithoutBackgroundAreBlackAndTransparent)
{
  this->scene.renderer->SetBackgroundAlpha(0.0);
  this->scene.window->SetAlphaBitPlanes(1);
  this->scene.render();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->scene.window->GetRGBACharPixelData(0, 0, 63, 63, 1, pixels);
  std::size_t shadow = 0;
  for (int i = 0; i < 64 * 64; ++i)
  {
    const glm::dvec2 place = this->scene.floorAt(i % 64, i / 64);
    double rgba[4];
    pixels->GetTuple(i, rgba);
    if (isUnder(place, hangingBox))
    {
      EXPECT_EQ(rgba[3], 255.0);
      continue;
    }
    EXPECT_EQ(rgba[0] + rgba[1] + rgba[2], 0.0);
    EXPECT_TRUE(rgba[3] == 0.0 || rgba[3] == 255.0) << rgba[3];
    shadow += rgba[3] == 255.0 ? 1 : 0;
  }
  EXPECT_GT(shadow, 100u);
}

TEST_F(CaughtShadowsTest, HighlightsAreNotShown)
{
  const Picture matt = this->scene.render();
  this->scene.floor()->GetProperty()->SetSpecular(1.0);
  EXPECT_EQ(this->scene.render(), matt);
}

TEST_F(CaughtShadowsTest, PropsWithoutShadowsAreNotSeen)
{
  vtkGnomonPropKeys::SetReceives(this->scene.floor(), false);
  this->scene.renderer->SetBackground(0.0, 0.0, 1.0);
  const Picture picture = this->scene.render();
  EXPECT_EQ(picture.at(1, 1), glm::ivec3(0, 0, 255));
  EXPECT_EQ(picture.at(44, 32), glm::ivec3(0, 0, 255)); // in the shadow
}

TEST_F(CaughtShadowsTest, PropsThatShareAMapperKeepTheirLook)
{
  vtkNew<vtkActor> twin;
  twin->SetMapper(this->scene.floor()->GetMapper());
  twin->SetProperty(this->scene.floor()->GetProperty());
  twin->SetPosition(41.0, 0.0, 0.0);
  this->scene.renderer->AddActor(twin);
  this->scene.lookDown(40.0, 20.0);
  const Picture picture = this->scene.render();
  EXPECT_EQ(picture.red(4, 32), 0); // the background behind the catcher
  EXPECT_NEAR(picture.red(50, 32), slantingSunValue, 1.0);
}

TEST_F(CaughtShadowsTest, AssembliesHandTheKeyToTheirParts)
{
  const Picture expected = this->scene.render();
  vtkNew<vtkAssembly> assembly;
  vtkSmartPointer<vtkActor> floor = this->scene.floor();
  floor->SetPropertyKeys(nullptr);
  this->scene.renderer->RemoveActor(floor);
  assembly->AddPart(floor);
  this->scene.renderer->AddActor(assembly);
  const Picture shown = this->scene.render();
  EXPECT_FALSE(shown == expected);
  vtkGnomonPropKeys::SetShadowCatcher(assembly, true);
  EXPECT_EQ(this->scene.render(), expected);
}

} // namespace
} // namespace gnomon::test
