// Views fitted to the visible receivers: what the report states, when views are fitted again, and
// how the picture changes.

#include "PassScene.h"

#include <vtkLineSource.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

struct Fitting : PassTest
{
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
using FittingOfKinds = PassTestOf<Kind, Fitting>;
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

/// A pixel is a tenth of a texel or less. The camera moves right and up by whole pixels, so that
/// the same places of the floor can be compared.
TEST_F(Fitting, snappedEdgesStayWhereTheyAreWhenTheCameraMoves)
{
  constexpr int side = 512;
  constexpr double halfHeight = 3.0;
  PassScene scene(side, side);
  this->fill(scene);
  scene.addSun({ 1.0, 0.7, -1.5 });
  scene.choose("fit=frame snap=on map_size=48");
  const auto drawAt = [&](int pixels)
  {
    const double moved = pixels * 2.0 * halfHeight / side;
    scene.lookDown(halfHeight, moved, moved);
    return drawKept(scene);
  };
  const VisibilityImages first = drawAt(0);
  ASSERT_EQ(scene.report().lights.at(0).fit, "receivers");
  const auto changed = [&](const VisibilityImages& other, int pixels)
  {
    return countPixels(first,
      [&](std::size_t i)
      {
        const glm::ivec2 at(static_cast<int>(i) % side, static_cast<int>(i) / side);
        return std::min(at.x, at.y) >= 60 && std::max(at.x, at.y) < side - 60 &&
          first.visibility[0][i] != other.visibility[0][i + pixels * (side - 1)];
      });
  };
  const std::size_t edges = changed(first, 1);
  EXPECT_GT(edges, 300u);
  for (int pixels = 1; pixels <= 50; ++pixels)
  {
    EXPECT_LE(100 * changed(drawAt(pixels), pixels), edges) << pixels;
  }
}
