// Filters on all kinds of maps; kinds of depth and early-outs that show the same.

#include "PassScene.h"

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

using NamedSettings = std::map<std::string, std::string>;

void choose(PassScene& scene, const char* technique, const NamedSettings& settings)
{
  scene.pass->SetTechnique(technique);
  for (const auto& [name, value] : settings)
  {
    scene.pass->SetSetting(name.c_str(), value.c_str());
  }
}

/// A closed world of boxes and a sphere on a slab.
void addClosedWorld(PassScene& scene)
{
  scene.addBox({ -4.0, -4.0, -0.5 }, { 4.0, 4.0, 0.0 });
  scene.addBox({ -1.0, -1.0, 0.8 }, { 0.5, 0.5, 2.0 });
  scene.addBox({ 1.5, -2.0, 0.0 }, { 2.5, -1.0, 1.5 });
  scene.addSphere({ -2.0, 1.5, 1.0 }, 0.8);
}

} // namespace

/// Along a shadow's edge that runs away from the camera, one split's texels end and the next
/// split's begin. Values in between must lie between both.
TEST_F(PassTest, blendedSplitsFadeIntoEachOther)
{
  PassScene scene(200, 200);
  scene.addFloor(100.0);
  scene.addBox({ -40.0, -100.0, 3.0 }, { 0.0, 100.0, 4.0 });
  scene.addSun({ 0.2, 0.13, -1.0 });
  scene.lookFrom({ 3.0, -98.0, 2.0 });
  scene.pass->SetTechnique("pssm");
  scene.pass->SetMapSize(128);
  const auto countBetween = [&](const char* blend)
  {
    scene.pass->SetSetting("split_blend", blend);
    const VisibilityImages& kept = drawKept(scene);
    return std::count_if(kept.visibility[0].begin(), kept.visibility[0].end(),
      [](float visibility) { return visibility > 0.0f && visibility < 1.0f; });
  };
  EXPECT_EQ(countBetween("0"), 0);
  EXPECT_GT(countBetween("0.3"), 20);
  EXPECT_EQ(scene.report().lights.at(0).fit, "frustum");

  // Compare both routes, and compare with the truth.
  const VisibilityImages blended = drawKept(scene);
  scene.pass->SetTechnique("raytraced");
  EXPECT_GT(compareVisibility(blended, drawKept(scene)).agreeing(), 0.97);
  scene.pass->SetTechnique("pssm");
  scene.pass->KeepVisibilityOff();
  scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_IMAGE);
  const Picture image = scene.render();
  scene.pass->SetRoute(vtkGnomonShadowPass::ROUTE_INLINE);
  EXPECT_EQ(differingPixels(scene.render(), image, 1), 0u);
}

/// A filter's edges are as wide as a split's texels require. With blended splits, brightness
/// changes less from row to row of pixels than where one split ends.
TEST_F(PassTest, blendedSplitsHaveNoBorder)
{
  PassScene scene(200, 400);
  scene.addFloor(100.0);
  scene.addBox({ -40.0, -100.0, 3.0 }, { 0.0, 100.0, 4.0 });
  scene.addSun({ 0.2, 0.0, -1.0 });
  scene.lookFrom({ 3.0, -98.0, 2.0 }, { 3.0, 100.0, -40.0 });
  scene.pass->SetTechnique("pssm");
  scene.pass->SetSetting("estimator", "pcf");
  scene.pass->SetSetting("kernel_size", "9");
  scene.pass->SetMapSize(128);
  const auto largestStep = [&](const char* blend)
  {
    scene.pass->SetSetting("split_blend", blend);
    const VisibilityImages& kept = drawKept(scene);
    float largest = 0.0f;
    for (std::size_t y = 0; y + 1 < 400; ++y)
    {
      for (std::size_t x = 0; x < 200; ++x)
      {
        const std::size_t i = y * 200 + x;
        if (kept.coverage[i] > 0.5f && kept.coverage[i + 200] > 0.5f && kept.normalZ[i] > 0.9f &&
          positionOf(kept, i).z < 0.1 && positionOf(kept, i + 200).z < 0.1)
        {
          largest =
            std::max(largest, std::abs(kept.visibility[0][i] - kept.visibility[0][i + 200]));
        }
      }
    }
    return largest;
  };
  const float without = largestStep("0");
  const float with = largestStep("0.3");
  EXPECT_LT(with, 0.7f * without);
}

TEST_F(PassTest, euclideanMapsShadowAsLinearOnesDo)
{
  for (const double cone : { 50.0, allDirections })
  {
    PassScene scene(300, 300);
    addClosedWorld(scene);
    scene.addSpot({ -1.0, -3.0, 5.0 }, glm::dvec3(0.0), cone);
    scene.lookFrom({ 4.0, -7.0, 6.0 });
    choose(scene, "nsm", { { "metric", "linear" } });
    const VisibilityImages linear = drawKept(scene);
    choose(scene, "nsm", { { "metric", "euclidean" } });
    const Agreement agreement = compareVisibility(linear, drawKept(scene));
    EXPECT_EQ(scene.report().mapBakes, 1);
    EXPECT_GT(agreement.covered, 20000u);
    EXPECT_LE(agreement.wrong, agreement.covered / 10000) << cone;
  }
}

TEST_F(PassTest, secondAndMidpointMapsOfClosedCastersHaveNoAcneAndTheSameShadows)
{
  for (const char* depth : { "first", "second", "midpoint" })
  {
    for (const char* technique : { "nsm", "pcf" })
    {
      for (const bool lamp : { false, true })
      {
        PassScene scene(300, 300);
        addClosedWorld(scene);
        const glm::dvec3 light(-4.0, -3.0, 6.0);
        lamp ? scene.addSpot(light, glm::dvec3(0.0), 50.0) : scene.addSun(-light);
        scene.lookFrom({ 4.0, -7.0, 6.0 });
        choose(scene, technique, { { "depth", depth } });
        const VisibilityImages mapped = drawKept(scene);
        scene.pass->SetTechnique("raytraced");
        const VisibilityImages& traced = drawKept(scene);
        const Agreement agreement = compareVisibility(mapped, traced);
        const double wrong = static_cast<double>(agreement.wrong) / agreement.covered;
        EXPECT_LT(wrong, 0.02) << depth << ", " << technique << ", lamp: " << lamp;
        // Count the slab's middle and the sphere, where they are lit, far from any shadow.
        std::size_t dark = 0;
        std::size_t lit = 0;
        for (std::size_t i = 0; i < traced.coverage.size(); ++i)
        {
          const glm::dvec3 point = positionOf(traced, i);
          const bool far = point.y < -2.5 && point.z < 0.01;
          if (traced.coverage[i] > 0.0f && far && traced.visibility[0][i] == 1.0f)
          {
            ++lit;
            dark += mapped.visibility[0][i] < 1.0f ? 1 : 0;
          }
        }
        EXPECT_GT(lit, 1000u);
        EXPECT_EQ(dark, 0u) << depth << ", " << technique << ", lamp: " << lamp;
      }
    }
  }
}

TEST_F(PassTest, aSheetCastsNoShadowIntoASecondDepthMap)
{
  const auto shadowOf = [](const char* depth)
  {
    PassScene scene(300, 300);
    scene.addFloor(4.0);
    scene.addFloor(1.0, 2.0);
    scene.addSun({ 1.0, 0.0, -1.0 });
    scene.lookDown(4.0);
    scene.pass->SetTechnique("nsm");
    scene.pass->SetSetting("depth", depth);
    return scene.redAt(scene.render(), 2.0, 0.0);
  };
  EXPECT_EQ(shadowOf("first"), 0);
  EXPECT_EQ(shadowOf("midpoint"), 0);
  EXPECT_NEAR(shadowOf("second"), slantingSunValue, 1.0);
}
