// Views fitted to the visible receivers: what the report states, when views are fitted again, and
// how the picture changes.

#include "PassScene.h"

#include <vtkLineSource.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;
using testing::HasSubstr;

namespace
{

class Fitting : public PassTest
{
protected:
  /// A wide floor with a box on it and others far from it, of which the camera sees a small part.
  static void fill(PassScene& scene)
  {
    addProps(scene);
    scene.lookFrom({ 0.0, -4.0, 4.0 });
  }
  static void addProps(PassScene& scene)
  {
    scene.addFloor(40.0);
    scene.addBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 });
    scene.addBox({ 38.0, 38.0, 0.0 }, { 39.0, 39.0, 3.0 });
    scene.addBox({ -39.0, -39.0, 0.0 }, { -38.0, -38.0, 3.0 });
  }
  /// Return the wrong pixels of a frame with kept visibility.
  static std::size_t wrong(PassScene& scene, const char* technique, const VisibilityImages& truth)
  {
    return compareVisibility(drawKept(scene, technique), truth).wrong;
  }
  static VisibilityImages truthOf(PassScene& scene) { return drawKept(scene, "raytraced"); }
};

/// One light of each kind over the scene of fill().
struct Kind
{
  const char* name;
  vtkLight* (*add)(PassScene&);
};
class FittingOfKinds
  : public Fitting
  , public testing::WithParamInterface<Kind>
{
protected:
  /// A cube's faces are not warped.
  static std::vector<std::string> techniquesFor(vtkLight* light)
  {
    const bool cube = light->GetPositional() && light->GetConeAngle() > 60.0;
    return cube ? std::vector<std::string>{ "nsm" } : std::vector<std::string>{ "nsm", "lispsm" };
  }
};
INSTANTIATE_TEST_SUITE_P(Kinds, FittingOfKinds,
  testing::Values(Kind{ "sun",
                    [](PassScene& scene) {
                      return scene.addSun({ 1.0, 0.4, -1.5 });
                    } },
    Kind{ "box",
      [](PassScene& scene)
      {
        vtkLight* light = scene.addSun({ 0.0, 0.0, -1.0 });
        light->SetPosition(-10.0, -4.0, 15.0);
        const double up[3] = { 0.0, 1.0, 0.0 };
        vtkGnomonLightKeys::SetBox(light, 60.0, 60.0, 90.0, up);
        return light;
      } },
    Kind{ "spot",
      [](PassScene& scene) {
        return scene.addSpot({ -20.0, -8.0, 30.0 }, glm::dvec3(0.0), 50.0);
      } },
    Kind{ "wideSpot",
      [](PassScene& scene) {
        return scene.addSpot({ -4.0, -1.6, 6.0 }, glm::dvec3(0.0), 80.0);
      } },
    Kind{ "point",
      [](PassScene& scene) {
        return scene.addSpot({ -4.0, -1.6, 6.0 }, glm::dvec3(0.0), allDirections);
      } }),
  byName);

} // namespace

TEST_F(Fitting, reportSaysWhatViewsAreFittedTo)
{
  PassScene scene(64, 48);
  this->fill(scene);
  scene.addSun({ 1.0, 0.4, -1.5 });
  const auto fitOf = [&](const char* technique, const char* fit, int route)
  {
    scene.choose(fit);
    scene.render({ technique, route });
    return scene.report().lights.at(0).fit;
  };
  const auto reason = [&] { return scene.report().lights.at(0).fitReason; };
  const int inlined = vtkGnomonShadowPass::ROUTE_INLINE;
  const int image = vtkGnomonShadowPass::ROUTE_IMAGE;
  EXPECT_EQ(fitOf("nsm", "fit=off", image), "off");
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(fitOf("nsm", "fit=frame", image), "receivers");
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(fitOf("nsm", "fit=once", image), "frustum");
  EXPECT_THAT(reason(), HasSubstr("made once"));
  EXPECT_EQ(fitOf("nsm", "fit=frame", inlined), "frustum");
  EXPECT_THAT(reason(), HasSubstr("inline route"));
  EXPECT_EQ(fitOf("pssm", "fit=off", image), "frustum");
  EXPECT_THAT(reason(), HasSubstr("fit=frame"));
  EXPECT_EQ(fitOf("pssm", "fit=frame", image), "receivers");
  EXPECT_EQ(fitOf("lispsm", "fit=off", image), "frustum");
  EXPECT_EQ(fitOf("lispsm", "fit=frame", image), "receivers");
  EXPECT_EQ(fitOf("lispsm", "fit=off", inlined), "frustum");
  EXPECT_EQ(fitOf("raytraced", "fit=frame", image), "");
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(fitOf("pcf", "fit=frame", image), "receivers");
  EXPECT_EQ(fitOf("vsm", "fit=frame", image), "receivers");
  scene.pass->SetSetting("split_blend", "0.1");
  EXPECT_EQ(fitOf("pssm", "fit=frame", image), "frustum");
  EXPECT_THAT(reason(), HasSubstr("overlap"));
  scene.pass->SetSetting("kernel_width", "0.1");
  EXPECT_EQ(fitOf("pcf", "fit=frame", image), "frustum");
  EXPECT_THAT(reason(), HasSubstr("width in world units"));
  EXPECT_EQ(fitOf("nsm", "fit=frame", image), "receivers");
  // Translucent surfaces are no receivers of the prepass.
  scene.addBox({ 1.0, 1.0, 1.0 }, { 1.5, 1.5, 1.5 })->GetProperty()->SetOpacity(0.5);
  EXPECT_EQ(fitOf("nsm", "fit=frame", image), "frustum");
  EXPECT_THAT(reason(), HasSubstr("translucent"));
}

TEST_F(Fitting, isDoneAgainOnlyWhenOtherReceiversMayBeSeen)
{
  PassScene scene(64, 48);
  this->fill(scene);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.choose("fit=frame snap=on");
  scene.choose({ "nsm", vtkGnomonShadowPass::ROUTE_IMAGE });
  const auto expectBakedOnce = [&]
  {
    for (const int bakes : { 1, 0 })
    {
      scene.render();
      EXPECT_EQ(scene.report().mapBakes, bakes);
    }
  };
  expectBakedOnce();
  scene.renderer->GetActiveCamera()->Azimuth(1.0);
  expectBakedOnce();
  // Props that are no surfaces hide receivers, too.
  vtkNew<vtkLineSource> line;
  line->SetPoint1(-1.0, -1.0, 1.0);
  line->SetPoint2(1.0, -1.0, 1.0);
  vtkActor* actor = scene.add(line);
  actor->GetProperty()->SetLineWidth(20.0f);
  expectBakedOnce();
  actor->VisibilityOff();
  expectBakedOnce();
  scene.window->SetSize(48, 64);
  expectBakedOnce();
  scene.pass->SetSetting("snap", "off");
  expectBakedOnce();
  scene.pass->SetTechnique("pssm");
  expectBakedOnce();
  scene.pass->SetSetting("split_lambda", "0.9");
  expectBakedOnce();
}

TEST_P(FittingOfKinds, leavesFewerWrongPixelsThanTheFrustum)
{
  PassScene scene(300, 300);
  this->fill(scene);
  GetParam().add(scene);
  scene.pass->SetMapSize(256);
  const VisibilityImages truth = this->truthOf(scene);
  scene.choose("fit=off snap=on");
  const std::size_t unfitted = this->wrong(scene, "nsm", truth);
  scene.choose("fit=once snap=off");
  const std::size_t frustum = this->wrong(scene, "nsm", truth);
  ASSERT_EQ(scene.report().lights.at(0).fit, "frustum");
  scene.choose("fit=frame snap=off");
  const std::size_t receivers = this->wrong(scene, "nsm", truth);
  ASSERT_EQ(scene.report().lights.at(0).fit, "receivers");
  EXPECT_LE(receivers, frustum);
  EXPECT_LT(2 * receivers, unfitted);
}

TEST_F(Fitting, bringsEveryEstimatorNearerToTheTruth)
{
  PassScene scene(240, 240);
  this->fill(scene);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.pass->SetMapSize(256);
  const VisibilityImages truth = this->truthOf(scene);
  // Filters blur over texels, so smaller texels blur less.
  const auto error = [&](const char* technique, const char* fit)
  {
    scene.choose(fit);
    return meanDifference(drawKept(scene, technique).visibility[0], truth.visibility[0]);
  };
  scene.choose("snap=off");
  for (const char* estimator :
    { "compare", "pcf", "adaptive", "variance", "exponential", "moments" })
  {
    scene.pass->SetSetting("estimator", estimator);
    for (const char* technique : { "nsm", "lispsm", "tsm", "pssm" })
    {
      SCOPED_TRACE(std::string(technique) + " with " + estimator);
      const double frustum = error(technique, "fit=once");
      ASSERT_EQ(scene.report().lights.at(0).fit, "frustum");
      const double receivers = error(technique, "fit=frame");
      ASSERT_EQ(scene.report().lights.at(0).fit, "receivers");
      EXPECT_LT(receivers, frustum);
    }
  }
}

TEST_F(Fitting, warpOfAViewAlongTheGroundFollowsTheReceivers)
{
  PassScene scene(320, 240);
  scene.addFloor(100.0);
  for (int i = 0; i < 12; ++i)
  {
    const double x = 3.0 * (i % 3) - 3.0;
    const double y = -85.0 + 14.0 * i;
    scene.addBox({ x, y, 0.0 }, { x + 0.8, y + 0.8, 2.5 });
  }
  scene.lookFrom({ 0.0, -95.0, 2.5 }, { 0.0, 0.0, 0.0 });
  scene.pass->SetSetting("map_size", "256");
  scene.addSun({ 1.0, 0.1, -0.6 });
  const VisibilityImages truth = this->truthOf(scene);
  scene.choose("fit=frame snap=off");
  const std::size_t uniform = this->wrong(scene, "nsm", truth);
  const std::size_t chosen = this->wrong(scene, "lispsm", truth);
  scene.choose("fit=off snap=on");
  const std::size_t published = this->wrong(scene, "lispsm", truth);
  EXPECT_GT(uniform, 50u);
  EXPECT_LE(chosen, 0.6 * static_cast<double>(uniform));
  EXPECT_LE(chosen, published);
}

TEST_F(Fitting, snappedEdgesStayWhereTheyAreWhenTheCameraMoves)
{
  // The floor from straight above. A pixel is a tenth of a texel or less. The camera moves by whole
  // pixels, so the same places of the floor can be compared.
  constexpr int side = 512;
  constexpr double halfHeight = 3.0;
  const double pixel = 2.0 * halfHeight / side;
  PassScene scene(side, side);
  this->fill(scene);
  scene.addSun({ 1.0, 0.7, -1.5 });
  scene.pass->SetMapSize(48);
  scene.choose("fit=frame snap=on");
  const auto drawAt = [&](int pixels)
  {
    scene.lookDown(halfHeight, pixels * pixel, pixels * pixel);
    return drawKept(scene).visibility.at(0);
  };
  const auto at = [](const std::vector<float>& image, int x, int y)
  { return image[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)]; };
  const std::vector<float> first = drawAt(0);
  ASSERT_EQ(scene.report().lights.at(0).fit, "receivers");
  std::size_t edges = 0;
  for (int y = 60; y < side - 60; ++y)
  {
    for (int x = 60; x < side - 60; ++x)
    {
      edges += at(first, x, y) != at(first, x + 1, y) || at(first, x, y) != at(first, x, y + 1);
    }
  }
  EXPECT_GT(edges, 300u);
  std::size_t worst = 0;
  for (int frame = 1; frame <= 50; ++frame)
  {
    const std::vector<float> moved = drawAt(frame);
    std::size_t changed = 0;
    for (int y = 60; y < side - 60; ++y)
    {
      for (int x = 60; x < side - 60; ++x)
      {
        // Row 0 is the top; the camera moves right and up.
        changed += at(first, x, y) != at(moved, x - frame, y + frame);
      }
    }
    worst = std::max(worst, changed);
  }
  EXPECT_LE(100 * worst, edges);
}
