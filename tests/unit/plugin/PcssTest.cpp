// Percentage closer soft shadows in frames, compared with known widths.

#include "HalfPlane.h"
#include "PassScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// Give a scene the technique, and its light an area.
std::function<void(PassScene&, vtkLight*)> soft(const char* radius)
{
  return [radius](PassScene& scene, vtkLight* light)
  {
    scene.pass->SetTechnique("pcss");
    vtkGnomonLightKeys::SetSetting(light, "light_radius", radius);
  };
}

std::vector<float> visibilityOf(PassScene& scene, const char* technique)
{
  scene.pass->SetTechnique(technique);
  return drawKept(scene).visibility.at(0);
}

double meanDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(a[i] - b[i]);
  }
  return sum / static_cast<double>(a.size());
}

/// Return the distance over which a rising profile goes from 0.1 to 0.9, in its steps.
double widthOf(const std::vector<double>& profile)
{
  const auto passes = [&](double level)
  {
    const auto above =
      std::find_if(profile.begin() + 1, profile.end(), [&](double v) { return v >= level; });
    EXPECT_NE(above, profile.end());
    const double before = *(above - 1);
    return static_cast<double>(above - profile.begin()) - (*above - level) / (*above - before);
  };
  return passes(0.9) - passes(0.1);
}

/// A disk's share is 0.1 if a chord cuts it at this part of its radius.
constexpr double chordOfTenth = 0.687;

/// A floor with the shadow of a half plane at height 2 that ends at x = 0, seen from above.
class Penumbra : public PassTest
{
protected:
  Penumbra()
  {
    // Texels are five times as long along x as along y.
    this->floor->SetScale(1.0, 0.2, 1.0);
    this->scene.addBox({ -12.0, -4.0, 1.999 }, { 0.0, 4.0, edgeHeight });
    this->scene.lookDown(1.0, 0.0);
    this->scene.renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 1.5); // below the half plane
    this->scene.renderer->GetActiveCamera()->SetClippingRange(0.1, 3.0);
  }

  /// The side of a pixel, in world units.
  double pixel() const { return this->scene.floorAt(1, 0).x - this->scene.floorAt(0, 0).x; }

  /// Expect the penumbra's width and profile to be those of geometry, at all sizes of the map.
  /// @param exact the visible share of the light from (x, 0, 0)
  /// @param tolerance of the width from 0.1 to 0.9, as a share
  void expectPenumbra(const std::vector<int>& mapSizes,
    const std::function<double(double x)>& exact, double tolerance)
  {
    double before = 0.0;
    for (const int mapSize : mapSizes)
    {
      this->scene.pass->SetMapSize(mapSize);
      const std::vector<double> profile = columnMeans(drawKept(this->scene));
      std::vector<double> exactProfile;
      int between = 0;
      for (std::size_t column = 0; column < profile.size(); ++column)
      {
        const double expected = exact(this->scene.floorAt(static_cast<int>(column), 0).x);
        exactProfile.push_back(expected);
        EXPECT_NEAR(profile[column], expected, 0.012) << column; // 0.15 is required
        between += expected > 0.0 && expected < 1.0 ? 1 : 0;
      }
      const double width = widthOf(profile) / widthOf(exactProfile);
      EXPECT_GT(between, 60);
      EXPECT_NEAR(width, 1.0, tolerance);                               // 15 % are required
      EXPECT_NEAR(width, before == 0.0 ? width : before, 0.02 * width); // 5 % are required
      before = width;
    }
  }

  static constexpr double edgeHeight = 2.0;
  PassScene scene{ 400, 400 };
  vtkActor* floor = this->scene.addFloor(20.0);
};

//------------------------------------------------------------------------------
TEST_F(Penumbra, ofASpotLightIsThatOfSimilarTriangles)
{
  this->scene.pass->SetTechnique("pcss");
  vtkNew<vtkGnomonAreaLight> lamp;
  lamp->SetPosition(0.0, 0.0, 10.0);
  lamp->SetFocalPoint(0.0, 0.0, 0.0);
  lamp->SetConeAngle(50.0);
  lamp->SetShapeToRectangle();
  lamp->SetUp(0.0, 1.0, 0.0);
  lamp->SetWidth(2.0);
  lamp->SetHeight(0.6);
  this->scene.renderer->AddLight(lamp);
  const LampPastEdge lampPastEdge{ edgeHeight, 10.0, 1.0 };
  this->expectPenumbra(
    { 1024, 4096 }, [&](double x) { return lampPastEdge.square(x); }, 0.02);
}

//------------------------------------------------------------------------------
TEST_F(Penumbra, ofTheSunIsThatOfItsAngle)
{
  soft("10")(this->scene, this->scene.addSun({ 0.0, 0.0, -1.0 }));
  const SunPastEdge sunPastEdge{ edgeHeight, std::tan(glm::radians(5.0)) };
  this->expectPenumbra(
    { 1024, 4096 }, [&](double x) { return sunPastEdge.disk(x); }, 0.05);
}

//------------------------------------------------------------------------------
TEST_F(Penumbra, ofAPointLightIsThatOfItsBall)
{
  soft("1")(this->scene, this->scene.addSpot({ 0.0, 0.0, 10.0 }, glm::dvec3(0.0), allDirections));
  const LampPastEdge lampPastEdge{ edgeHeight, 10.0, 1.0 };
  this->expectPenumbra(
    { 2048 }, [&](double x) { return lampPastEdge.ball(x); }, 0.05);
}

//------------------------------------------------------------------------------
TEST_F(Penumbra, asPublishedIsAShareOfTheConesMap)
{
  // Receivers at 10, blockers at 8. The filter's disk is a quarter of the light's width, and a 16th
  // more, as a share of a map of the whole cone. The cone is 2 tan(cone) wide at distance 1. The
  // floor would darken itself.
  vtkGnomonPropKeys::SetCasts(this->floor, false);
  this->scene.pass->SetTechnique("pcss");
  this->scene.pass->SetSetting("as_published", "on");
  this->scene.pass->SetSetting("pcss_samples", "high");
  this->scene.pass->SetMapSize(4096);
  vtkLight* lamp = this->scene.addSpot({ 0.0, 0.0, 10.0 }, glm::dvec3(0.0), 50.0);
  for (const double cone : { 50.0, 30.0 })
  {
    lamp->SetConeAngle(cone);
    for (const double radius : { 0.0125, 0.025 })
    {
      vtkGnomonLightKeys::SetSetting(lamp, "light_radius", std::to_string(radius).c_str());
      const double disk =
        0.25 * (2.0 * radius) * 1.0625 * 2.0 * std::tan(glm::radians(cone)) * 10.0;
      const double exact = 2.0 * chordOfTenth * disk;
      const double width = widthOf(columnMeans(drawKept(this->scene))) * this->pixel();
      EXPECT_NEAR(width, exact, 0.05 * exact) << cone << " " << radius;
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(Penumbra, isSmootherFromPresetToPreset)
{
  soft("10")(this->scene, this->scene.addSun({ 0.0, 0.0, -1.0 }));
  double previous = 1.0;
  for (const char* preset : { "low", "medium", "high" })
  {
    this->scene.pass->SetSetting("pcss_samples", preset);
    // All pixels of a column have one true value. With the same pattern in each pixel, they have
    // one value, in steps. Turned patterns make the steps noise of less than a level in 30
    // (medium).
    const VisibilityImages& kept = drawKept(this->scene);
    const std::vector<double> means = columnMeans(kept);
    double noise = 0.0;
    double steps = 0.0;
    int columns = 0;
    for (std::size_t x = 1; x < means.size(); ++x)
    {
      if (means[x] <= 0.1 || means[x] >= 0.9)
      {
        continue;
      }
      for (std::size_t i = x; i < kept.visibility[0].size(); i += means.size())
      {
        noise += std::pow(kept.visibility[0][i] - means[x], 2.0) / kept.height;
      }
      steps = columns == 0 ? 0.0 : std::max(steps, std::abs(means[x] - means[x - 1]));
      ++columns;
    }
    ASSERT_GT(columns, 30);
    noise = std::sqrt(noise / columns);
    EXPECT_GT(noise, 0.001) << preset;
    EXPECT_LT(noise, 0.6 * previous) << preset;
    EXPECT_LT(steps, 2.0 / columns) << preset;
    if (preset == std::string("medium"))
    {
      EXPECT_GT(noise, 0.005);
      EXPECT_LT(noise, 0.05);
    }
    previous = noise;
  }
}

//------------------------------------------------------------------------------
class Pcss : public PassTest
{
protected:
  /// Boxes and a ball on a floor, one of them hovering.
  static void addThings(PassScene& scene)
  {
    scene.addFloor(4.0);
    scene.addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
    scene.addSphere({ 1.3, 0.8, 1.4 }, 0.5);
    scene.addBox({ -2.0, 1.0, 1.0 }, { -1.0, 2.0, 1.2 });
    scene.lookFrom({ 2.0, -8.0, 7.0 });
  }
  static vtkLight* addLamp(PassScene& scene)
  {
    return scene.addSpot({ -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 50.0);
  }
  /// Look down at the floor from below the hanging casters.
  static void lookFromBelow(PassScene& scene, double halfHeight, double x, double height)
  {
    scene.lookDown(halfHeight, x);
    scene.renderer->GetActiveCamera()->SetPosition(x, 0.0, height);
    scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 3.0);
  }
  /// The truth by rays to 256 points.
  static std::vector<float> truthOf(PassScene& scene)
  {
    scene.pass->SetTechnique("raytraced");
    scene.pass->SetSetting("light_samples", "256");
    return visibilityOf(scene, "raytraced");
  }
  /// Count the pixels for which a predicate of two images holds.
  template <typename Predicate>
  static int countBoth(const std::vector<float>& a, const std::vector<float>& b, Predicate holds)
  {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      count += holds(a[i], b[i]) ? 1 : 0;
    }
    return count;
  }
  /// Expect that the early out changes nothing, and that nearly all partly hidden pixels are
  /// darkened.
  static void expectCastersFound(
    PassScene& scene, const std::vector<float>& truth, const char* what)
  {
    const std::vector<float> softly = visibilityOf(scene, "pcss");
    scene.pass->SetSetting("early_out", "none");
    EXPECT_EQ(visibilityOf(scene, "pcss"), softly) << what;
    const int partly = countBoth(truth, softly, [](float t, float) { return t < 0.9f; });
    const int found =
      countBoth(truth, softly, [](float t, float s) { return t < 0.9f && s < 0.97f; });
    EXPECT_GT(partly, 2000) << what;
    EXPECT_GT(found, 0.95 * partly) << what;
  }
};

//------------------------------------------------------------------------------
TEST_F(Pcss, aLightWithoutSizeIsThePlainShadowMap)
{
  for (const bool point : { true, false })
  {
    PassScene scene(200, 150);
    addThings(scene);
    addLamp(scene);
    scene.addSun({ 0.4, 0.5, -1.0 });
    scene.addSpot({ 1.0, -1.5, 3.0 }, glm::dvec3(0.0), allDirections);
    scene.pass->SetSetting("light_radius", point ? "0" : "1e-9");
    scene.pass->SetTechnique("nsm");
    const std::vector<std::vector<float>> hard = drawKept(scene).visibility;
    scene.pass->SetTechnique("pcss");
    const std::vector<std::vector<float>> seen = drawKept(scene).visibility;
    ASSERT_EQ(hard.size(), 3u);
    for (std::size_t i = 0; i < hard.size(); ++i)
    {
      const int different = countBoth(hard[i], seen[i], std::not_equal_to<>());
      // The border takes a texel more, which may move every other texel.
      EXPECT_LE(different, point ? 0 : 200 * 150 / 200) << i;
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(Pcss, isNearTheTruthUnderEveryLightAndProjection)
{
  struct Case
  {
    const char* projection;
    const char* fit;
    double cone; ///< 0: the sun
  };
  PassScene scene(120, 90);
  addThings(scene);
  vtkLight* const sun = scene.addSun({ 0.4, 0.5, -1.0 });
  vtkLight* const lamp = addLamp(scene);
  double lit = -1.0; // the light for which the truth was computed
  std::vector<float> truth;
  for (const auto& [projection, fit, cone] : { Case{ "uniform", "off", 0.0 },
         { "lispsm", "frame", 0.0 }, { "tsm", "frame", 0.0 }, { "pssm", "frame", 0.0 },
         { "uniform", "frame", 0.0 }, { "uniform", "off", 50.0 }, { "lispsm", "frame", 50.0 },
         { "pssm", "frame", 50.0 }, { "cube", "off", 75.0 }, { "cube", "off", allDirections } })
  {
    sun->SetSwitch(cone == 0.0);
    lamp->SetSwitch(cone > 0.0);
    lamp->SetConeAngle(cone);
    scene.pass->SetSetting("light_radius", cone > 0.0 ? "0.4" : "6");
    if (lit != cone)
    {
      truth = truthOf(scene);
      lit = cone;
    }
    scene.pass->SetTechnique("pcss");
    scene.pass->SetSetting("projection", projection);
    scene.pass->SetSetting("fit", fit);
    const double error = meanDifference(visibilityOf(scene, "pcss"), truth);
    const double hard = meanDifference(visibilityOf(scene, "nsm"), truth);
    EXPECT_LT(error, 0.0015) << projection << " " << fit << " " << cone;
    EXPECT_LT(error, 0.25 * hard) << projection << " " << fit << " " << cone;
    scene.pass->SetSetting("projection", "technique");
  }
}

//------------------------------------------------------------------------------
/// A large lamp above a floor, and a high caster. Faces of the lamp's cube that see the floor below
/// do not see the caster: its share of the lamp is found on other faces.
TEST_F(Pcss, castersOnOtherFacesOfTheCubeAreFound)
{
  PassScene scene(100, 100);
  scene.addFloor(1.5);
  scene.addBox({ 0.5, -3.0, 1.55 }, { 0.6, 3.0, 1.95 });
  soft("2")(scene, scene.addSpot({ 0.0, 0.0, 2.0 }, glm::dvec3(0.0), 85.0));
  lookFromBelow(scene, 0.4, -0.4, 1.5);
  const std::vector<float> hard = visibilityOf(scene, "nsm");
  EXPECT_EQ(std::count(hard.begin(), hard.end(), 1.0f), 100 * 100) << "the light's centre sees all";
  expectCastersFound(scene, truthOf(scene), "");
}

//------------------------------------------------------------------------------
/// A floor that casts nothing under a large lamp, and a screen close beside the lamp. The cube's
/// face that sees most of the floor holds no casters. Other faces are cut to the screen, which lies
/// elsewhere on them.
TEST_F(Pcss, castersAreFoundFromFacesWithout)
{
  for (const char* shape : { "ball", "disk", "rectangle" })
  {
    PassScene scene(100, 100);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), false);
    scene.addBox({ 0.6, -0.8, 1.6 }, { 0.7, 0.8, 2.4 });
    if (shape == std::string("ball"))
    {
      soft("0.5")(scene, scene.addSpot({ 0.0, 0.0, 2.0 }, glm::dvec3(0.0), allDirections));
    }
    else
    {
      vtkNew<vtkGnomonAreaLight> light;
      light->SetPosition(0.0, 0.0, 2.0);
      light->SetFocalPoint(0.0, 0.0, 0.0);
      light->SetConeAngle(90.0);
      light->SetRadius(0.5);
      light->SetWidth(0.6);
      light->SetHeight(0.6);
      light->SetUp(0.0, 1.0, 0.0);
      shape == std::string("disk") ? light->SetShapeToDisk() : light->SetShapeToRectangle();
      scene.renderer->AddLight(light);
    }
    lookFromBelow(scene, 2.5, 1.5, 1.5);
    const std::vector<float> truth = truthOf(scene);
    expectCastersFound(scene, truth, shape);
    const std::vector<float> softly = visibilityOf(scene, "pcss");
    EXPECT_LE(countBoth(truth, softly, [](float t, float s) { return t == 1.0f && s < 0.9f; }), 10)
      << shape;
    EXPECT_LT(meanDifference(softly, truth), 0.035) << shape;
  }
}

//------------------------------------------------------------------------------
/// A lamp amid casters on all sides, over a floor that five faces of its cube see. Rays pass
/// through faces without receivers.
TEST_F(Pcss, isNotFittedToTheCameraUnderALampThatSeesAllAround)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  // Just beside the face below, above receivers on that face.
  scene.addBox({ 0.5, -1.0, 0.52 }, { 0.55, 1.0, 1.4 });
  scene.addBox({ -1.4, 0.6, 0.0 }, { -0.4, 0.9, 0.7 });
  scene.addSphere({ -0.8, -0.7, 1.0 }, 0.4);
  scene.addBox({ -0.3, -0.2, 0.2 }, { 0.1, 0.1, 0.25 });
  vtkLight* const lamp = scene.addSpot({ 0.0, 0.0, 1.0 }, glm::dvec3(0.0), allDirections);
  soft("0.3")(scene, lamp);
  scene.pass->SetMapSize(512);
  scene.lookDown(0.5, 0.8);
  const std::vector<float> whole = visibilityOf(scene, "pcss");
  for (const char* fit : { "off", "frame", "once" })
  {
    scene.pass->SetSetting("fit", fit);
    EXPECT_EQ(visibilityOf(scene, "pcss"), whole) << fit;
    EXPECT_EQ(scene.report().lights.at(0).fit, "off") << fit;
  }
  // A light without an area is fitted.
  soft("0")(scene, lamp);
  drawKept(scene);
  EXPECT_EQ(scene.report().lights.at(0).fit, "frustum");
}

//------------------------------------------------------------------------------
/// A caster near the lamp makes a search's area large. Few of its points then find the edge of a
/// low caster, which causes salt-and-pepper noise.
TEST_F(Pcss, searchesLeaveNoSpecks)
{
  PassScene scene(120, 120);
  scene.addFloor(4.0);
  scene.addBox({ -3.0, -3.0, 0.3 }, { 0.0, 3.0, 0.35 });
  scene.addBox({ 0.26, -0.05, 3.0 }, { 0.3, 0.05, 3.05 });
  soft("0.5")(scene, scene.addSpot({ 0.0, 0.0, 6.0 }, glm::dvec3(0.0), 40.0));
  scene.pass->SetMapSize(4096);
  lookFromBelow(scene, 0.1, 0.0, 0.25); // below the low caster
  const std::vector<float> truth = truthOf(scene);
  EXPECT_GT(
    std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.1f && v < 0.9f; }), 2000);
  for (const char* preset : { "low", "medium", "high" })
  {
    scene.pass->SetSetting("pcss_samples", preset);
    // Five times the noise of the lowest preset.
    EXPECT_EQ(countBoth(truth, visibilityOf(scene, "pcss"),
                [](float t, float s) { return std::abs(s - t) > 0.35f; }),
      0)
      << preset;
  }
}

//------------------------------------------------------------------------------
/// A ball light beside a screen, whose shadow crosses from one face of the lamp's cube to the next
/// at x = 1. Visibility has the same error on both sides.
TEST_F(Pcss, hasNoSeamsWhereFacesOfTheCubeMeet)
{
  PassScene scene(100, 100);
  scene.addFloor(4.0);
  scene.addBox({ 0.4, -3.0, 0.62 }, { 0.45, 3.0, 1.4 });
  soft("0.3")(scene, scene.addSpot({ 0.0, 0.0, 1.0 }, glm::dvec3(0.0), allDirections));
  scene.lookDown(0.4, 1.0);
  scene.pass->SetTechnique("raytraced");
  scene.pass->SetSetting("light_samples", "256");
  const std::vector<double> truth = columnMeans(drawKept(scene));
  scene.pass->SetTechnique("pcss");
  const std::vector<double> softly = columnMeans(drawKept(scene));
  constexpr std::size_t strip = 5; // columns, 0.008 wide each
  double off[2] = {};
  double seen = 0.0;
  for (std::size_t column = 50 - strip; column < 50 + strip; ++column)
  {
    off[column < 50 ? 0 : 1] += (softly[column] - truth[column]) / strip;
    seen += truth[column] / (2 * strip);
  }
  EXPECT_GT(seen, 0.2);
  EXPECT_LT(seen, 0.8);
  EXPECT_LT(std::abs(off[1] - off[0]), 0.01);
}

//------------------------------------------------------------------------------
/// The shadow of a box on the floor, where a ball close to the lamp hides a part of the lamp, too.
TEST_F(Pcss, contactsAreSeenInWidePenumbrae)
{
  PassScene scene(200, 150);
  scene.addFloor(4.0);
  scene.addSphere({ 0.7, 0.0, 3.3 }, 0.3);
  scene.addBox({ 1.0, -0.5, 0.0 }, { 1.4, 0.5, 1.0 });
  soft("0.4")(scene, scene.addSpot({ 0.0, 0.0, 4.0 }, { 1.0, 0.0, 0.0 }, 50.0));
  lookFromBelow(scene, 0.6, 1.9, 2.0); // below the ball
  const std::vector<float> truth = truthOf(scene);
  const std::vector<float> softly = visibilityOf(scene, "pcss");
  const int dark = countBoth(truth, softly, [](float t, float) { return t < 0.1f; });
  const int lost = countBoth(truth, softly, [](float t, float s) { return t < 0.1f && s > 0.3f; });
  EXPECT_GT(dark, 1000);
  EXPECT_LT(lost, 0.02 * dark);
  EXPECT_LT(meanDifference(softly, truth), 0.06);
}

//------------------------------------------------------------------------------
/// A ball's penumbra is that of its rim, which lies behind its middle as seen from the lamp.
TEST_F(Pcss, roundCastersHaveThePenumbraOfTheirRims)
{
  PassScene scene(150, 150);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.2 }, 0.8);
  soft("0.4")(scene, scene.addSpot({ 0.0, 0.0, 4.0 }, glm::dvec3(0.0), 40.0));
  lookFromBelow(scene, 2.0, 0.0, 0.3); // below the ball
  const std::vector<float> truth = truthOf(scene);
  EXPECT_LT(meanDifference(visibilityOf(scene, "pcss"), truth),
    0.2 * meanDifference(visibilityOf(scene, "nsm"), truth));
}

//------------------------------------------------------------------------------
/// Each pixel has one class. Pixels decided by bounds are neither searched nor filtered, and a
/// larger light has more filtered pixels.
TEST_F(Pcss, tellsWhatTheEarlyOutDecides)
{
  PassScene scene(200, 150);
  addThings(scene);
  vtkLight* const lamp = addLamp(scene);
  const auto classesOf = [&](const char* radius, const char* earlyOut)
  {
    soft(radius)(scene, lamp);
    scene.pass->SetSetting("early_out", earlyOut);
    std::map<std::string, std::int64_t> counts;
    const std::vector<float> visibility = drawKept(scene).visibility[0];
    std::int64_t all = 0;
    for (const gnomon::ClassCount& of : scene.report().lights.at(0).classes)
    {
      counts[of.name] = of.pixels;
      all += of.pixels;
    }
    EXPECT_EQ(all, 200 * 150);
    const auto between = std::count_if(
      visibility.begin(), visibility.end(), [](float v) { return v > 0.0f && v < 1.0f; });
    EXPECT_LE(between, counts["by the map's texels"]) << radius << earlyOut;
    return counts;
  };
  std::int64_t filtered = 0;
  for (const char* radius : { "0.1", "0.4", "1.2" })
  {
    auto none = classesOf(radius, "none");
    auto exact = classesOf(radius, "exact");
    EXPECT_EQ(none["lit by the map's bounds"] + none["in shadow by the map's bounds"], 0);
    EXPECT_GT(exact["lit by the map's bounds"], 0) << radius;
    for (const char* alike : { "no receiver", "turned away from the light" })
    {
      EXPECT_GT(exact[alike], 0) << alike;
      EXPECT_EQ(exact[alike], none[alike]) << alike;
    }
    EXPECT_EQ(
      exact["no blocker found"] + exact["lit by the map's bounds"], none["no blocker found"]);
    EXPECT_EQ(exact["by the map's texels"] + exact["in shadow by the map's bounds"],
      none["by the map's texels"]);
    EXPECT_GT(exact["by the map's texels"], filtered) << radius;
    filtered = exact["by the map's texels"];
  }
}

//------------------------------------------------------------------------------
/// Where the light is fully hidden, `pcss` shows a little of it in some pixels.
TEST_F(Pcss, fewLightLeaksGrowWithTheLight)
{
  PassScene scene(200, 150);
  addThings(scene);
  vtkLight* const lamp = addLamp(scene);
  struct Case
  {
    const char* radius;
    int mostLit; ///< pixels
  };
  int litOfSmall = 0;
  int litOfLarge = 0;
  for (const auto& [radius, mostLit] :
    { Case{ "0.1", 3 }, { "0.4", 3 }, { "1.2", 12 }, { "2", 16 } })
  {
    soft(radius)(scene, lamp);
    const std::vector<float> truth = truthOf(scene);
    EXPECT_GT(std::count(truth.begin(), truth.end(), 0.0f), 300) << radius;
    const int lit = countBoth(
      truth, visibilityOf(scene, "pcss"), [](float t, float s) { return t == 0.0f && s > 0.05f; });
    EXPECT_LE(lit, mostLit) << radius;
    (mostLit > 3 ? litOfLarge : litOfSmall) += lit;
  }
  EXPECT_GT(litOfLarge, litOfSmall); // although fewer pixels are dark
}

//------------------------------------------------------------------------------
/// The shadow of a post on the floor, under a sun at 45 degrees. Its penumbrae are as wide as the
/// distance to the post makes them.
TEST_F(Pcss, shadowsHardenTowardsTheirContact)
{
  PassScene scene(320, 320);
  scene.addFloor(6.0);
  scene.addBox({ -0.001, -0.5, 0.0 }, { 0.0, 0.5, 3.5 });
  soft("6")(scene, scene.addSun({ 1.0, 0.0, -1.0 }));
  scene.pass->SetMapSize(4096);
  scene.pass->SetSetting("pcss_samples", "high");
  scene.lookDown(1.4, 1.4);
  const VisibilityImages& kept = drawKept(scene);
  const double pixel = scene.floorAt(1, 0).x - scene.floorAt(0, 0).x;
  double previous = 0.0;
  for (const double along : { 0.2, 0.5, 0.8, 1.1, 1.4, 1.7, 2.0, 2.3, 2.6 })
  {
    // Return the shares of a row of columns, from the shadow's middle to its side, on both sides.
    const auto column = static_cast<int>(along / pixel);
    std::vector<double> shares(static_cast<std::size_t>(kept.height / 2), 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      for (int x = column - 4; x <= column + 4; ++x)
      {
        const int away = static_cast<int>(i);
        for (const int y : { kept.height / 2 + away, kept.height / 2 - 1 - away })
        {
          shares[i] += kept.visibility[0][static_cast<std::size_t>(y * kept.width + x)] / 18.0;
        }
      }
    }
    const double width = widthOf(shares) * pixel;
    // Half the sun's angle, over the slant distance to the post.
    const double exact = 2.0 * chordOfTenth * std::tan(glm::radians(3.0)) * std::sqrt(2.0) *
      scene.floorAt(column, 0).x;
    EXPECT_GT(width, previous) << along;
    EXPECT_NEAR(width, exact, 0.08 * exact) << along; // 15 % are required of widths
    previous = width;
  }
}

//------------------------------------------------------------------------------
TEST_F(Pcss, asPublishedNeedsABiasThatGrowsWithTheLight)
{
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.lookDown(1.0, 0.0);
  const glm::dvec3 place(4.0, 0.0, 3.0);
  vtkLight* lamp = scene.addSpot(place, glm::dvec3(0.0), 50.0);
  scene.pass->SetSetting("as_published", "on");
  const auto dark = [&](const char* radius, const char* bias)
  {
    soft(radius)(scene, lamp);
    scene.pass->SetSetting("bias_slope", bias);
    const Acne acne = countAcneOfLamp(drawKept(scene), place);
    EXPECT_GT(acne.facing, 1000u);
    return acne.dark;
  };
  EXPECT_GT(dark("0.01", "0"), 1000u);
  EXPECT_EQ(dark("0.01", "5"), 0u);
  EXPECT_GT(dark("0.05", "5"), 1000u);
  EXPECT_EQ(dark("0.05", "100"), 0u);
}

//------------------------------------------------------------------------------
TEST_F(Pcss, asPublishedIsForSpotLightsAlone)
{
  PassScene scene(100, 80);
  addThings(scene);
  vtkLight* const lamp = addLamp(scene);
  soft("0")(scene, lamp);
  const std::vector<float> hard = visibilityOf(scene, "nsm");
  scene.pass->SetSetting("as_published", "on");
  EXPECT_EQ(visibilityOf(scene, "pcss"), hard); // a light without area
  soft("0.1")(scene, lamp);
  scene.render();
  EXPECT_EQ(scene.report().lights.at(0).estimator, "pcss_as_published");
  const auto expectRefused = [&]
  {
    scene.render();
    EXPECT_THAT(scene.report().misfits,
      testing::ElementsAre(testing::HasSubstr("spot lights with a single view")));
    EXPECT_EQ(scene.report().lights.at(0).estimator, "compare") << "what it has instead";
  };
  for (const double cone : { 70.0, allDirections })
  {
    lamp->SetConeAngle(cone);
    expectRefused();
  }
  lamp->SetConeAngle(50.0);
  vtkGnomonLightKeys::SetSetting(lamp, "projection", "pssm");
  expectRefused();
  EXPECT_THAT(this->takeErrors(), testing::HasSubstr("spot lights with a single view"));
}

//------------------------------------------------------------------------------
TEST_F(Pcss, lightsInTheFloorsPlaneAreCleanOnTheFloor)
{
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.lookFrom({ 2.0, -8.0, 7.0 });
  vtkLight* lamp = scene.addSpot({ 3.0, 0.0, 1.0 }, { 0.0, 0.0, 1.0 }, allDirections);
  scene.pass->SetMapSize(256);
  for (const double height : { 0.5, 0.01, 1e-4 })
  {
    lamp->SetPosition(3.0, 0.0, height);
    for (const char* radius : { "0.3", "3", "1000" })
    {
      soft(radius)(scene, lamp);
      const Acne acne = countAcneOfLamp(drawKept(scene), { 3.0, 0.0, height });
      EXPECT_GT(acne.facing, 1000u);
      EXPECT_EQ(acne.dark, 0u) << height << " " << radius;
    }
  }
}

} // namespace
