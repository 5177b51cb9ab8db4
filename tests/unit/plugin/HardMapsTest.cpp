// The quality of hard shadow maps of all projections with default settings: no detached shadows.

#include "PassScene.h"
#include "Variant.h"

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

class HardMaps
  : public PassTest
  , public testing::WithParamInterface<Variant>
{
protected:
  static void choose(PassScene& scene) { GetParam().choose(scene); }
};

INSTANTIATE_TEST_SUITE_P(Layouts, HardMaps,
  testing::ValuesIn(
    variantsThat([](const Variant& variant) { return variant.info().name == "compare"; })),
  testing::PrintToStringParamName());

class BakedMaps : public HardMaps
{
};

INSTANTIATE_TEST_SUITE_P(All, BakedMaps,
  testing::ValuesIn(variantsThat(
    [](const Variant& variant)
    {
      return variant.info().bakesMap() && variant.text.find("kernel_") == std::string::npos &&
        variant.text.find("light_radius") == std::string::npos;
    })),
  testing::PrintToStringParamName());

} // namespace

TEST_P(BakedMaps, receiversThatDoNotCastMayLieBehindAllCasters)
{
  for (const bool spot : { false, true })
  {
    PassScene scene(300, 300);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), false);
    scene.addSphere({ -1.0, 0.0, 2.5 }, 0.7);
    spot ? scene.addSpot({ -2.0, 0.0, 5.0 }, glm::dvec3(0.0), 50.0)
         : scene.addSun({ 1.0, 0.4, -1.5 });
    scene.lookFrom({ 0.0, -9.0, 7.0 });
    scene.pass->SetTechnique("raytraced");
    const VisibilityImages traced = drawKept(scene);
    this->choose(scene);
    const Agreement agreement = compareVisibility(drawKept(scene), traced);
    EXPECT_GT(agreement.covered, 20000u);
    // The map's square has empty corners; moments blur its edges.
    EXPECT_LE(agreement.wrong, GetParam().isMoments() ? 150u : 40u) << "spot: " << spot;
  }
}

TEST_P(HardMaps, shadowsTouchTheirCasters)
{
  // A wall on a floor, seen from above. Its shadow must begin within a texel of x = 0.1.
  PassScene scene(400, 400);
  this->choose(scene);
  scene.addFloor(4.0);
  scene.addBox({ -0.1, -3.0, 0.0 }, { 0.1, 3.0, 1.0 });
  scene.addSun({ 1.0, 0.0, -1.0 });
  for (const int mapSize : { 256, 1024 })
  {
    scene.pass->SetMapSize(mapSize);
    scene.lookDown(0.2, 0.2);
    const Picture picture = scene.render();
    // The floor's extent across the light, and the length of a texel's footprint on the floor.
    const double texel = (8.0 + 1.0) / mapSize * std::sqrt(2.0);
    for (const int y : { 100, 200, 300 })
    {
      int firstDark = -1;
      for (int x = picture.width - 1; x >= 0; --x)
      {
        const double floorX = scene.floorAt(x, y).x;
        if (floorX > 0.1 && picture.red(x, y) == 0)
        {
          firstDark = x;
        }
      }
      ASSERT_GE(firstDark, 0);
      EXPECT_LE(scene.floorAt(firstDark, y).x - 0.1, texel + 0.002) << "map " << mapSize;
    }
  }
}

TEST_P(HardMaps, thinPostsCastWhereverTheyCoverTexelCentres)
{
  PassScene scene(300, 300);
  this->choose(scene);
  scene.addFloor(4.0);
  for (int i = -3; i <= 3; ++i)
  {
    scene.addBox({ i - 0.01, -0.01, 0.0 }, { i + 0.01, 0.01, 1.0 });
  }
  scene.addSun({ 0.3, 1.0, -1.0 });
  scene.lookFrom({ 0.0, -6.0, 6.0 });
  scene.pass->SetMapSize(2048); // 0.02 is 5 texels
  const VisibilityImages mapped = drawKept(scene);
  scene.pass->SetTechnique("raytraced");
  const VisibilityImages traced = drawKept(scene);
  const Agreement agreement = compareVisibility(mapped, traced);
  const std::size_t shadow = countPixels(traced,
    [&](std::size_t i)
    {
      return traced.coverage[i] > 0.0f && traced.normalZ[i] > 0.9f &&
        traced.visibility[0][i] == 0.0f;
    });
  EXPECT_GT(shadow, 150u);
  EXPECT_LE(agreement.wrong, shadow / 2);
}

TEST_P(HardMaps, smallestMapStillShadows)
{
  PassScene scene(200, 200);
  this->choose(scene);
  scene.addFloor(4.0);
  scene.addBox({ -1.0, -1.0, 1.0 }, { 1.0, 1.0, 3.0 });
  scene.addSun({ 1.0, 0.0, -1.0 });
  scene.pass->SetMapSize(16);
  scene.lookDown(4.0);
  const Picture picture = scene.render();
  EXPECT_EQ(scene.redAt(picture, 2.5, 0.0), 0);
  EXPECT_NEAR(scene.redAt(picture, -3.0, 0.0), 180, 1);
}
