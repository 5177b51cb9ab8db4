// Techniques with soft shadows under area lights, in difficult scenes. Values stay finite, OpenGL
// reports no error, and visibility differs from the ray-traced one by no more than is stated here.

#include "AreaLights.h"

#include <iterator>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

/// Sets up casters, receivers, an area light and the camera.
using Build = std::function<vtkLight*(PassScene&)>;

/// A horizontal sheet.
void addSheet(PassScene& scene, const glm::dvec2& lower, const glm::dvec2& upper, double z)
{
  const auto sheet =
    planeOf({ lower.x, lower.y, z }, { upper.x, lower.y, z }, { lower.x, upper.y, z });
  sheet->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  scene.add(sheet);
}

/// A box that stands on a slab and a sphere that hangs over it, scaled by `unit` and moved by
/// `offset`.
void addThings(PassScene& scene, double unit = 1.0, const glm::dvec3& offset = glm::dvec3(0.0))
{
  const auto place = [&](double x, double y, double z)
  { return offset + unit * glm::dvec3(x, y, z); };
  scene.addBox(place(-4.0, -4.0, -0.2), place(4.0, 4.0, 0.0));
  scene.addBox(place(-2.0, -1.0, 0.0), place(-0.5, 1.0, 1.5));
  scene.addSphere(place(1.5, 0.0, 1.2), 0.8 * unit);
  scene.lookFrom(place(0.0, -9.0, 7.0), place(0.0, 0.0, 0.0));
}

/// Add a light.
Build softSun(const glm::dvec3& direction, const char* degrees)
{
  return [=](PassScene& scene) { return addSoftSun(scene, direction, degrees); };
}
Build softBall(const glm::dvec3& place, const char* radius)
{
  return [=](PassScene& scene) { return addBall(scene, place, radius); };
}
const glm::dvec3 down(0.0, 0.0, -1.0);
Build softDisk(const glm::dvec3& place, double radius, const glm::dvec3& travel = down,
  double coneAngleDegrees = 90.0)
{
  return [=](PassScene& scene)
  { return addDisk(scene, place, place + travel, radius, coneAngleDegrees); };
}
const glm::dvec3 slantingSoftly(1.0, 0.4, -1.5);
const glm::dvec3 over(2.0, -2.0, 5.0);

Build overThings(const Build& addLight)
{
  return [=](PassScene& scene)
  {
    addThings(scene);
    return addLight(scene);
  };
}

/// Other casters, on a floor that casts or not.
Build overFloor(
  const Build& addLight, const std::function<void(PassScene&)>& addOthers, bool casts = true)
{
  return [=](PassScene& scene)
  {
    vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), casts);
    addOthers(scene);
    scene.lookFrom({ 0.0, -9.0, 7.0 });
    return addLight(scene);
  };
}

Build thingsAt(double unit, const glm::dvec3& offset)
{
  return [=](PassScene& scene)
  {
    addThings(scene, unit, offset);
    return softDisk(offset + unit * over, 0.5 * unit)(scene);
  };
}

vtkActor* addBowl(PassScene& scene, double radius, double endDegrees)
{
  const auto bowl = ballOf(glm::dvec3(0.0), radius, 24, 24);
  bowl->SetEndPhi(endDegrees);
  return scene.add(bowl);
}

/// The largest difference of a technique from the truth.
struct Bound
{
  double meanAbsolute;
  std::size_t spots; ///< pixels; see SoftError
};

/// The soft techniques with a map.
constexpr const char* mapTechniques[] = { "pcss", "montecarlo", "sampled", "coherence" };

/// For lamps inside a caster, where rounding decides the side: visibility only has to be finite.
constexpr Bound anything{ 1.0, 120 * 90 };

struct SoftCase
{
  const char* name;
  double tracedMeanAbsolute; ///< of 64 rays
  Bound mapped[4];           ///< in the order of mapTechniques
  Build build;
};

const std::vector<SoftCase>& softCases()
{
  static const std::vector<SoftCase> cases = {
    { "disk", 0.001, { { 0.0016, 0 }, { 0.0031, 3 }, { 0.00082, 0 }, { 0.001, 0 } },
      overThings(softDisk(over, 0.5)) },
    { "zeroSize", 0.0002, { { 0.0005, 0 }, { 0.0005, 0 }, { 0.0005, 0 }, { 0.0002, 0 } },
      overThings(softDisk(over, 0.0)) },
    // The hard shadow's edges have an error of a part of a texel: 0.0002 to 0.0019 by the map's
    // position. Maps of `sampled` have many positions, so their error is the mean of that.
    { "tinySun", 0.0002, { { 0.0009, 0 }, { 0.0009, 0 }, { 0.0013, 0 }, { 0.0002, 0 } },
      overThings(softSun(slantingSoftly, "1e-6")) },
    // On the box's top, in it and close to it; around, in and at casters.
    { "diskOnTheBox", 0.0002, { { 0.00054, 0 }, { 0.0056, 0 }, { 0.0002, 0 }, { 0.0002, 0 } },
      overThings(softDisk({ -1.2, 0.0, 1.5001 }, 0.3)) },
    { "diskInTheBoxesTop", 0.0002, { { 0.02, 100 }, { 0.019, 96 }, { 0.019, 100 }, { 0.0002, 0 } },
      overThings(softDisk({ -1.2, 0.0, 1.5 }, 0.3)) },
    // Where floats round.
    { "diskInTheBoxesTopElsewhere", 0.0002, { anything, anything, anything, { 0.0002, 0 } },
      [](PassScene& scene)
      {
        const glm::dvec3 offset(0.013, 0.027, 0.0371);
        addThings(scene, 1.0, offset);
        return softDisk(offset + glm::dvec3(-1.2, 0.0, 1.5), 0.3)(scene);
      } },
    { "diskUnderTheBoxesTop", 0.0002,
      { { 0.0034, 71 }, { 0.0002, 0 }, { 0.00045, 7 }, { 0.0002, 0 } },
      overThings(softDisk({ -1.2, 0.0, 1.4999 }, 0.3)) },
    { "diskOnTheFloor", 0.0005, { { 0.12, 130 }, { 0.12, 130 }, { 0.045, 130 }, { 0.0005, 0 } },
      overThings(softDisk({ 0.5, -2.0, 0.001 }, 0.5)) },
    { "ballThroughTheBoxesTop", 0.0049,
      { { 0.12, 3286 }, { 0.0059, 0 }, { 0.0031, 4 }, { 0.0049, 0 } },
      overThings(softBall({ -1.2, 0.0, 1.6 }, "0.3")) },
    { "ballInTheBox", 0.0002, { { 0.00019, 2 }, { 0.0002, 0 }, { 0.00022, 3 }, { 0.0002, 0 } },
      overThings(softBall({ -1.2, 0.0, 0.8 }, "0.2")) },
    { "ballAroundTheSphere", 0.024, { { 0.61, 0 }, { 0.036, 0 }, { 0.02, 0 }, { 0.024, 0 } },
      overThings(softBall({ 1.5, 0.0, 1.2 }, "1.2")) },
    { "ballTouchesTheFloor", 0.0004,
      { { 0.00069, 15 }, { 0.00072, 0 }, { 0.00024, 0 }, { 0.0004, 0 } },
      overThings(softBall({ 0.5, -2.0, 0.3 }, "0.3")) },
    // Receivers in the light's plane, and behind it.
    { "diskInTheFloor", 0.0002, { anything, anything, anything, { 0.0002, 0 } },
      overThings(softDisk({ 0.5, -2.0, 0.0 }, 0.5)) },
    { "pointInTheFloor", 0.0002, { anything, anything, anything, { 0.0002, 0 } },
      overThings(softDisk({ 0.5, -2.0, 0.0 }, 0.0)) },
    { "diskInTheBoxesTopsPlane", 0.0017,
      { { 0.0034, 0 }, { 0.0032, 0 }, { 0.0014, 0 }, { 0.0017, 0 } },
      overThings(softDisk({ 1.0, -2.0, 1.5 }, 0.5)) },
    { "diskStandsOnTheFloor", 0.0035, { { 0.019, 0 }, { 0.0058, 0 }, { 0.0051, 0 }, { 0.0035, 0 } },
      overThings(softDisk({ 2.5, -2.5, 0.5 }, 1.0, { -1.0, 0.3, 0.0 })) },
    { "receiversBehindTheDisk", 0.0022,
      { { 0.018, 0 }, { 0.0036, 0 }, { 0.0019, 0 }, { 0.0022, 0 } },
      overThings(softDisk({ 0.5, -1.0, 1.0 }, 0.4, { 1.0, 0.5, 0.0 })) },
    // Grazing receivers.
    { "sunAlongTheFloor", 0.0004, { { 0.0013, 0 }, { 0.00098, 0 }, { 0.00036, 0 }, { 0.0004, 0 } },
      overThings(softSun({ 1.0, 0.2, -0.02 }, "1")) },
    { "sunAcrossTheHorizon", 0.0027, { { 0.0046, 0 }, { 0.0048, 0 }, { 0.0028, 0 }, { 0.0027, 0 } },
      overThings(softSun({ 1.0, 0.2, -0.05 }, "20")) },
    // Huge lights.
    { "sunOfHalfTheSky", 0.011, { { 0.049, 0 }, { 0.01, 0 }, { 0.011, 0 }, { 0.019, 0 } },
      overThings(softSun(slantingSoftly, "120")) },
    { "ballOfTheScenesSize", 0.0061, { { 0.0092, 0 }, { 0.0075, 0 }, { 0.006, 0 }, { 0.0061, 0 } },
      overThings(softBall({ 3.0, -3.0, 9.0 }, "5")) },
    { "diskOfTenScenes", 0.019, { { 0.17, 0 }, { 0.014, 0 }, { 0.018, 0 }, { 0.043, 0 } },
      overThings(softDisk({ 0.0, 0.0, 6.0 }, 80.0)) },
    // Sheets, whose other side is lit as well, and open meshes.
    { "sheets", 0.0012, { { 0.0023, 0 }, { 0.0038, 3 }, { 0.0021, 31 }, { 0.0012, 0 } },
      overFloor(softDisk(over, 0.5),
        [](PassScene& scene)
        {
          addSheet(scene, { -3.0, -1.0 }, { -1.0, 1.0 }, 0.001);
          addSheet(scene, { -0.5, -1.0 }, { 1.0, 1.0 }, 0.5);
          addSheet(scene, { 0.0, -1.0 }, { 1.5, 1.0 }, 0.501);
          addSheet(scene, { 2.0, -2.0 }, { 3.0, 2.0 }, 1.5);
        }) },
    { "sheetsAlongTheLight", 0.0013, { { 0.0057, 0 }, { 0.0087, 0 }, { 0.0017, 0 }, { 0.0013, 0 } },
      overFloor(softDisk({ 0.5, 0.0, 6.0 }, 0.3),
        [](PassScene& scene)
        {
          for (int i = 0; i < 6; ++i)
          {
            vtkActor* sheet = scene.addFloor(1.0);
            sheet->SetOrientation(0.0, 90.0, 0.0);
            sheet->SetPosition(-2.5 + i, 0.0, 1.0);
          }
        }) },
    { "halfSpheres", 0.0008, { { 0.0014, 0 }, { 0.0026, 0 }, { 0.00056, 0 }, { 0.0008, 0 } },
      overFloor(softDisk(over, 0.5),
        [](PassScene& scene)
        {
          addBowl(scene, 1.0, 90.0)->SetPosition(-1.5, 0.0, 0.2);
          vtkActor* turned = addBowl(scene, 1.0, 90.0);
          turned->SetPosition(1.5, 0.0, 1.2);
          turned->RotateX(180.0);
        }) },
    { "lampInAShade", 0.0093, { { 0.0096, 0 }, { 0.013, 0 }, { 0.0088, 0 }, { 0.0093, 0 } },
      overFloor(softBall({ 0.0, 0.0, 2.0 }, "0.15"),
        [](PassScene& scene)
        {
          addBowl(scene, 0.6, 110.0)->SetPosition(0.0, 0.0, 2.0);
          scene.addBox({ 1.5, -0.5, 0.0 }, { 2.5, 0.5, 0.8 });
        }) },
    // Faces of the lamp's cube that hold no casters, and others that are cut to a screen beside the
    // lamp.
    { "floorThatCastsNothing", 0.0076,
      { { 0.009, 0 }, { 0.0081, 0 }, { 0.0088, 0 }, { 0.0093, 0 } },
      overFloor(
        softBall({ 0.0, 0.0, 2.0 }, "0.5"),
        [](PassScene& scene) {
          scene.addBox({ 0.6, -0.8, 1.6 }, { 0.7, 0.8, 2.4 });
        },
        false) },
    { "postsOfATexel", 0.0008, { { 0.0012, 0 }, { 0.003, 0 }, { 0.0008, 0 }, { 0.0008, 0 } },
      overFloor(softDisk({ 0.0, -3.0, 6.0 }, 0.3),
        [](PassScene& scene)
        {
          for (int i = 0; i < 15; ++i)
          {
            const double x = -3.5 + 0.5 * i;
            scene.addBox({ x, -0.02, 0.0 }, { x + 0.04, 0.02, 1.5 });
          }
        }) },
    { "unitsOfAThousandth", 0.001, { { 0.0016, 0 }, { 0.0031, 3 }, { 0.00082, 0 }, { 0.001, 0 } },
      thingsAt(1e-3, glm::dvec3(0.0)) },
    { "unitsOfAMillion", 0.001, { { 0.0016, 0 }, { 0.0031, 3 }, { 0.00082, 0 }, { 0.001, 0 } },
      thingsAt(1e6, glm::dvec3(0.0)) },
    { "aMillionAway", 0.001, { { 0.0019, 0 }, { 0.0035, 3 }, { 0.00098, 0 }, { 0.001, 0 } },
      thingsAt(1.0, { 1e6, -1e6, 1e6 }) },
  };
  return cases;
}

/// Surfaces seen edge-on are not shaded. The image route knows its normals to this precision.
constexpr double leastCosine = 1e-5;

/// The difference of a technique from the truth.
struct SoftError
{
  double meanAbsolute = 0.0;
  /// Pixels that are not fully lit or dark though all around them are, in truth: acne and leaks.
  std::size_t spots = 0;
};

/// True if all pixels around one have this visibility, over the width of montecarlo's filter.
bool isAmong(const VisibilityImages& truth, std::size_t pixel, float visibility)
{
  const int at = static_cast<int>(pixel);
  return holdsAround({ truth.width, truth.height }, at % truth.width, at / truth.width, 6,
    [&](int column, int row)
    {
      return truth.visibility[0][static_cast<std::size_t>(row * truth.width + column)] ==
        visibility;
    });
}

SoftError errorOf(
  const std::vector<float>& visibility, const VisibilityImages& truth, vtkLight* light)
{
  SoftError error;
  error.meanAbsolute = meanDifferenceWhere(visibility, truth.visibility[0], 0,
    [&](std::size_t i)
    {
      if (truth.coverage[i] < 0.5f || cosineTowards(truth, i, light) <= leastCosine)
      {
        return false;
      }
      error.spots += (visibility[i] < 0.95f && isAmong(truth, i, 1.0f)) ||
          (visibility[i] > 0.05f && isAmong(truth, i, 0.0f))
        ? 1
        : 0;
      return true;
    });
  return error;
}

using SoftHardCases = PassTestOf<SoftCase>;

INSTANTIATE_TEST_SUITE_P(All, SoftHardCases, testing::ValuesIn(softCases()), byName);

TEST_P(SoftHardCases, stayFiniteAndNearTheTruth)
{
  const SoftCase& softCase = GetParam();
  PassScene scene(120, 90);
  scene.pass->SetMapSize(512);
  vtkLight* const light = softCase.build(scene);
  // drawKept() checks that numbers are finite and in [0, 1].
  const VisibilityImages truth = drawKept(scene, "raytraced light_samples=1024 light_seed=1");
  scene.choose("light_samples=64 light_seed=0");
  const std::vector<float> traced = scene.visibilityBy("raytraced");
  EXPECT_EQ(scene.visibilityBy("penumbra"), traced);
  const auto measure = [&](const char* name, const auto& visibility, const Bound& bound)
  {
    const SoftError error = errorOf(visibility, truth, light);
    EXPECT_LE(error.meanAbsolute, bound.meanAbsolute) << name;
    EXPECT_LE(error.spots, bound.spots) << name;
  };
  measure("raytraced", traced, { softCase.tracedMeanAbsolute, 0 });
  for (std::size_t i = 0; i < std::size(mapTechniques); ++i)
  {
    const char* const technique = mapTechniques[i];
    measure(technique, scene.visibilityBy(technique), softCase.mapped[i]);
  }
}

/// Bounds that replace a search give the same result as the search.
TEST_P(SoftHardCases, showTheSameByBounds)
{
  PassScene scene(120, 90);
  scene.pass->SetMapSize(512);
  GetParam().build(scene);
  const std::vector<float> asked = scene.visibilityBy("pcss early_out=exact");
  EXPECT_EQ(scene.visibilityBy("pcss early_out=none"), asked);
  scene.choose("mc_filter=0");
  const std::vector<float> searched = scene.visibilityBy("montecarlo mc_classify=off");
  for (const char* classify : { "mc_classify=pixels", "mc_classify=rays" })
  {
    EXPECT_LE(countDifferences(scene.visibilityBy(classify), searched), 1u)
      << classify << ": rays that rounding cuts elsewhere, 1 in 10,000";
  }
}

} // namespace
