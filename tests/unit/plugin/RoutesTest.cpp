// Both routes with all techniques, and scenes far away and of other sizes.

#include "BuiltinPass.h"
#include "LiveObjects.h"
#include "PassScene.h"
#include "Variant.h"

#include <vtkCollectionRange.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

struct Placing
{
  const char* name;
  const char* technique;
  double distance; ///< along all axes
  double scale;
};

using PointwiseScenes = PassTestOf<Variant>;

using PlacedScenes = PassTestOf<Placing>;

INSTANTIATE_TEST_SUITE_P(Placings, PlacedScenes,
  testing::ValuesIn(
    []
    {
      std::vector<Placing> all;
      for (const gnomon::TechniqueEntry& technique : gnomon::registry())
      {
        const char* const name = technique.name.c_str();
        all.insert(all.end(),
          { { "far", name, 4e6, 1.0 }, { "small", name, 0.0, 1e-4 }, { "tiny", name, 0.0, 1e-18 },
            { "large", name, 0.0, 1e4 }, { "huge", name, 0.0, 1e18 } });
      }
      return all;
    }()),
  [](const testing::TestParamInfo<Placing>& placing)
  { return std::string(placing.param.name) + "_" + placing.param.technique; });

/// Move a whole scene with its camera and lights; props move by their matrices.
void place(vtkRenderer* renderer, const Placing& placing)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(placing.distance, placing.distance, placing.distance);
  transform->Scale(placing.scale, placing.scale, placing.scale);
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    vtkNew<vtkTransform> placed;
    placed->SetMatrix(transform->GetMatrix());
    placed->Concatenate(actor->GetUserMatrix());
    actor->SetUserMatrix(placed->GetMatrix());
  }
  for (int i = 0; i < renderer->GetLights()->GetNumberOfItems(); ++i)
  {
    vtkLight* const light = lightOf(renderer, i);
    light->SetPosition(transform->TransformDoublePoint(light->GetPosition()));
    light->SetFocalPoint(transform->TransformDoublePoint(light->GetFocalPoint()));
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* range = camera->GetClippingRange();
  const double nearest = range[0] * placing.scale;
  const double farthest = range[1] * placing.scale;
  camera->SetPosition(transform->TransformDoublePoint(camera->GetPosition()));
  camera->SetFocalPoint(transform->TransformDoublePoint(camera->GetFocalPoint()));
  camera->SetClippingRange(nearest, farthest);
}

} // namespace

TEST_BY_VARIANTS(PointwiseScenes, BothRoutes, &Variant::isPointwise)
{
  SphereUnderSun scene(256, 256);
  vtkLight* const sun = scene.sun;
  GetParam().choose(scene);
  const auto expectTheSame = [&]
  {
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_INLINE);
    const Picture direct = scene.render();
    EXPECT_EQ(scene.report().route, "inline");
    scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
    EXPECT_LE(differingPixels(direct, scene.render(), 1), 3u);
    EXPECT_EQ(scene.report().route, "image");
  };
  // Views fitted in every frame give the image route other texels.
  scene.pass->SetSetting("fit", "once");
  expectTheSame();
  scene.pass->SetSetting("fit", "off");
  expectTheSame();
  sun->SetPositional(true);
  sun->SetConeAngle(GetParam().takesCubes() ? allDirections : 60.0);
  sun->SetExponent(0.0);
  sun->SetPosition(-2.0, -0.8, 3.0);
  expectTheSame();
}

TEST_P(PlacedScenes, haveTheSameVisibility)
{
  const Placing& placing = GetParam();
  const BuiltinPass near("primitives", 320);
  const BuiltinPass placed("primitives", 320);
  place(placed.renderer, placing);
  const Agreement agreement =
    compareVisibility(near.draw(placing.technique), placed.draw(placing.technique));
  EXPECT_GT(agreement.covered, 50000u);
  EXPECT_GE(agreement.agreeing(), 0.9999) << agreement.wrong << " wrong, " << agreement.coverage
                                          << " covered otherwise, of " << agreement.covered;
}

/// More lights than texture units.
TEST_F(PassTest, lightsByTheDozenShowAllTheirShadows)
{
  PassScene scene(80, 60);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.2 }, 0.7);
  vtkActor* const pane = scene.addFloor(1.0, 0.1);
  pane->GetProperty()->SetOpacity(0.5);
  pane->SetPosition(3.0, 0.0, 0.0);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  constexpr int count = 10;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 6.2832 * i / count;
    scene.addSun({ std::cos(angle), std::sin(angle), -1.5 })->SetIntensity(1.5 / count);
  }
  scene.window->Initialize();
  TakenUnits taken(scene.window);
  taken.giveBack(6); // of them, and of VTK
  const Picture mapped = scene.render();
  EXPECT_EQ(scene.report().route, "image");
  EXPECT_THAT(scene.report().notes, testing::Contains(testing::HasSubstr("translucent surfaces")));
  const Picture smooth = scene.render("raytraced edge_samples=16");
  EXPECT_EQ(differingPixels(smooth, scene.render("edge_samples=auto"), 1), 0u);
  const Picture traced = scene.render("edge_samples=1");
  EXPECT_LE(differingPixels(mapped, traced, 8), 20u);
  EXPECT_GT(differingPixels(scene.renderPlain(), traced, 8), 100u);
}

/// More lights than an image has bits. Each light's hard shadow shows with that light's brightness.
TEST_F(PassTest, hardShadowsOfManyLightsAreThoseOfEach)
{
  PassScene scene(80, 60);
  scene.addFloor(4.0);
  scene.addBox({ -0.5, -0.5, 1.0 }, { 0.5, 0.5, 2.0 });
  scene.lookDown(3.0);
  scene.pass->SetTechnique("raytraced");
  constexpr int count = 36;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 6.2832 * i / count;
    scene.addSun({ std::cos(angle), std::sin(angle), -1.5 })
      ->SetIntensity((1 + i % 5) / (3.0 * count));
  }
  for (const bool oneLess : { false, true })
  {
    const VisibilityImages kept = drawKept(scene);
    const Picture picture = scene.render();
    ASSERT_EQ(kept.visibility.size(), oneLess ? count - 1u : count);
    const std::size_t dark = countPixels(kept,
      [&](std::size_t pixel)
      {
        if (!(positionOf(kept, pixel).z < 0.5))
        {
          return false;
        }
        double value = 0.0;
        for (std::size_t i = 0; i < kept.visibility.size(); ++i)
        {
          vtkLight* const light = lightOf(scene.renderer, kept.sceneIndices[i]);
          value += kept.visibility[i][pixel] * light->GetIntensity() * 1.5 / std::sqrt(3.25);
        }
        const int at = static_cast<int>(pixel);
        EXPECT_NEAR(picture.red(at % 80, 59 - at / 80), 255.0 * value, 1.0) << pixel;
        return value < 0.75;
      });
    EXPECT_GT(dark, 100u);
    lightOf(scene.renderer)->SwitchOff(); // the others then have other bits
  }
}
