// Percentage closer soft shadows: what SoftLightsTest does not see. Widths, searches, the faces of
// a lamp's cube, and the published filter.

#include "AreaLights.h"

namespace gnomon::test
{
namespace
{

/// A disk's share is 0.1 if a chord cuts it at this part of its radius.
constexpr double chordOfTenth = 0.687;

/// Return the side of a pixel of lookDown, in world units.
double pixelOf(const PassScene& scene)
{
  return scene.floorAt(1, 0).x - scene.floorAt(0, 0).x;
}

vtkLight* addLamp(PassScene& scene)
{
  return scene.addSpot({ -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 50.0);
}

/// Give a light an area, and the scene the technique.
void soften(PassScene& scene, vtkLight* light, const char* radius)
{
  scene.pass->SetTechnique("pcss");
  set(light, "light_radius", radius);
}

/// The truth by rays to 256 points.
std::vector<float> truthOf(PassScene& scene)
{
  return scene.visibilityBy("raytraced light_samples=256");
}

/// Count the pixels for which a predicate of two images holds.
template <typename Predicate>
int countBoth(const std::vector<float>& a, const std::vector<float>& b, Predicate holds)
{
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += holds(a[i], b[i]) ? 1 : 0;
  }
  return count;
}

using Pcss = PassTest;

/// A scene in which only searches beyond the receiver's own surroundings find casters.
struct SearchedScene
{
  const char* name;
  void (*build)(PassScene& scene);
  double meanOff;        ///< the largest mean error
  int leastPartlyHidden; ///< pixels
};
const SearchedScene searchedScenes[] = {
  // A large lamp and a high caster. Faces of the lamp's cube that see the floor below do not see
  // the caster.
  { "castersOnOtherFaces",
    [](PassScene& scene)
    {
      scene.addFloor(1.5);
      scene.addBox({ 0.5, -3.0, 1.55 }, { 0.6, 3.0, 1.95 });
      set(scene.addSpot({ 0.0, 0.0, 2.0 }, glm::dvec3(0.0), 85.0), "light_radius", "2");
      scene.lookDown(0.4, -0.4, 0.0, 1.5);
    },
    1.0, 2000 },
  // A ball close to the lamp hides a part of the lamp from the contact of a box.
  { "contactsInWidePenumbrae",
    [](PassScene& scene)
    {
      scene.addFloor(4.0);
      scene.addSphere({ 0.7, 0.0, 3.3 }, 0.3);
      scene.addBox({ 1.0, -0.5, 0.0 }, { 1.4, 0.5, 1.0 });
      set(scene.addSpot({ 0.0, 0.0, 4.0 }, { 1.0, 0.0, 0.0 }, 50.0), "light_radius", "0.4");
      scene.lookDown(0.6, 1.9, 0.0, 2.0); // below the ball
    },
    0.06, 2000 },
  // A ball's penumbra is that of its rim, which lies behind its middle as seen from the lamp.
  { "rimsOfRoundCasters",
    [](PassScene& scene)
    {
      scene.addFloor(4.0);
      scene.addSphere({ 0.0, 0.0, 1.2 }, 0.8);
      set(scene.addSpot({ 0.0, 0.0, 4.0 }, glm::dvec3(0.0), 40.0), "light_radius", "0.4");
      scene.lookDown(2.0, 0.0, 0.0, 0.3); // below the ball
    },
    0.01, 1000 },
};
using PcssSearches = PassTestOf<SearchedScene>;
INSTANTIATE_TEST_SUITE_P(All, PcssSearches, testing::ValuesIn(searchedScenes), byName);

} // namespace

/// The early out changes nothing, nearly all partly hidden pixels are darkened, and hardly a wholly
/// hidden one is lit.
TEST_P(PcssSearches, findTheCasters)
{
  PassScene scene(100, 100);
  GetParam().build(scene);
  const std::vector<float> truth = truthOf(scene);
  const std::vector<float> softly = scene.visibilityBy("pcss");
  scene.set("early_out", "none");
  EXPECT_EQ(scene.visibilityBy("pcss"), softly);
  const auto count = [&](const auto& holds) { return countBoth(truth, softly, holds); };
  const int partly = count([](float t, float) { return t < 0.9f; });
  EXPECT_GT(partly, GetParam().leastPartlyHidden);
  EXPECT_GT(count([](float t, float s) { return t < 0.9f && s < 0.97f; }), 0.95 * partly);
  const int dark = count([](float t, float) { return t < 0.1f; });
  EXPECT_LE(count([](float t, float s) { return t < 0.1f && s > 0.3f; }), 0.02 * dark);
  EXPECT_LE(count([](float t, float s) { return t == 1.0f && s < 0.9f; }), 10);
  EXPECT_LT(meanDifference(softly, truth), GetParam().meanOff);
}

TEST_F(Pcss, asPublishedIsAShareOfTheConesMap)
{
  // Receivers at 10, blockers at 8. The filter's disk is a quarter of the light's width, and a 16th
  // more, as a share of a map of the whole cone. The cone is 2 tan(cone) wide at distance 1. The
  // floor would darken itself.
  HalfPlaneScene scene(400, 400, 1.0);
  vtkGnomonPropKeys::SetCasts(scene.floor(), false);
  scene.choose("pcss as_published=on pcss_samples=high map_size=4096");
  vtkLight* lamp = scene.addSpot({ 0.0, 0.0, 10.0 }, glm::dvec3(0.0), 50.0);
  for (const double cone : { 50.0, 30.0 })
  {
    lamp->SetConeAngle(cone);
    for (const double radius : { 0.0125, 0.025 })
    {
      set(lamp, "light_radius", std::to_string(radius).c_str());
      const double disk =
        0.25 * (2.0 * radius) * 1.0625 * 2.0 * std::tan(glm::radians(cone)) * 10.0;
      const double exact = 2.0 * chordOfTenth * disk;
      const double width = widthOf(columnMeans(drawKept(scene))) * pixelOf(scene);
      EXPECT_NEAR(width, exact, 0.05 * exact) << cone << " " << radius;
    }
  }
}

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
  soften(scene, lamp, "0.3");
  scene.pass->SetMapSize(512);
  scene.lookDown(0.5, 0.8);
  const std::vector<float> whole = scene.visibilityBy("pcss");
  for (const char* fit : { "off", "frame", "once" })
  {
    scene.set("fit", fit);
    EXPECT_EQ(scene.visibilityBy("pcss"), whole) << fit;
    EXPECT_EQ(scene.report().lights.at(0).fit, "off") << fit;
  }
  // A light without an area is fitted.
  soften(scene, lamp, "0");
  drawKept(scene);
  EXPECT_EQ(scene.report().lights.at(0).fit, "frustum");
}

/// A caster near the lamp makes a search's area large. Few of its points then find the edge of a
/// low caster, which causes salt-and-pepper noise.
TEST_F(Pcss, searchesLeaveNoSpecks)
{
  PassScene scene(120, 120);
  scene.addFloor(4.0);
  scene.addBox({ -3.0, -3.0, 0.3 }, { 0.0, 3.0, 0.35 });
  scene.addBox({ 0.26, -0.05, 3.0 }, { 0.3, 0.05, 3.05 });
  soften(scene, scene.addSpot({ 0.0, 0.0, 6.0 }, glm::dvec3(0.0), 40.0), "0.5");
  scene.pass->SetMapSize(4096);
  scene.lookDown(0.1, 0.0, 0.0, 0.25); // below the low caster
  const std::vector<float> truth = truthOf(scene);
  EXPECT_GT(
    std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.1f && v < 0.9f; }), 2000);
  for (const char* preset : { "low", "medium", "high" })
  {
    scene.set("pcss_samples", preset);
    // Five times the noise of the lowest preset.
    EXPECT_EQ(countBoth(truth, scene.visibilityBy("pcss"),
                [](float t, float s) { return std::abs(s - t) > 0.35f; }),
      0)
      << preset;
  }
}

/// Each pixel has one class. Pixels decided by bounds are neither searched nor filtered, and a
/// larger light has more filtered pixels.
TEST_F(Pcss, tellsWhatTheEarlyOutDecides)
{
  PassScene scene(200, 150);
  scene.addThings();
  vtkLight* const lamp = addLamp(scene);
  const auto classesOf = [&](const char* radius, const char* earlyOut)
  {
    soften(scene, lamp, radius);
    scene.set("early_out", earlyOut);
    std::map<std::string, std::int64_t> counts;
    const std::vector<float> visibility = drawKept(scene).visibility[0];
    std::int64_t all = 0;
    for (const ClassCount& of : scene.report().lights.at(0).classes)
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

TEST_F(Pcss, asPublishedNeedsABiasThatGrowsWithTheLight)
{
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.lookDown(1.0, 0.0);
  const glm::dvec3 place(4.0, 0.0, 3.0);
  vtkLight* lamp = scene.addSpot(place, glm::dvec3(0.0), 50.0);
  scene.set("as_published", "on");
  const auto dark = [&](const char* radius, const char* bias)
  {
    soften(scene, lamp, radius);
    scene.set("bias_slope", bias);
    const Acne acne = countAcne(drawKept(scene), [&](const glm::dvec3& at) { return place - at; });
    EXPECT_GT(acne.facing, 1000u);
    return acne.dark;
  };
  EXPECT_GT(dark("0.01", "0"), 1000u);
  EXPECT_EQ(dark("0.01", "5"), 0u);
  EXPECT_GT(dark("0.05", "5"), 1000u);
  EXPECT_EQ(dark("0.05", "100"), 0u);
}

TEST_F(Pcss, asPublishedIsForSpotLightsAlone)
{
  PassScene scene(100, 80);
  scene.addThings();
  vtkLight* const lamp = addLamp(scene);
  soften(scene, lamp, "0");
  const std::vector<float> hard = scene.visibilityBy("nsm");
  scene.set("as_published", "on");
  EXPECT_EQ(scene.visibilityBy("pcss"), hard); // a light without area
  soften(scene, lamp, "0.1");
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
  set(lamp, "projection", "pssm");
  expectRefused();
  EXPECT_THAT(this->takeErrors(), testing::HasSubstr("spot lights with a single view"));
}

} // namespace gnomon::test
