// Planar shadows equal rays on flat receivers, and do not occur elsewhere.

#include "PassScene.h"

#include "lights/LightSamples.h"

#include <vtkDataArray.h>

using namespace gnomon::test;
using gnomon::VisibilityImages;
using testing::HasSubstr;

namespace
{

bool isEdge(const VisibilityImages& truth, int x, int y)
{
  const auto at = [&](int column, int row)
  { return static_cast<std::size_t>(row * truth.width + column); };
  const auto isLikeHere = [&, here = at(x, y)](int column, int row)
  {
    const std::size_t there = at(column, row);
    const glm::dvec3 turn = glm::abs(normalOf(truth, there) - normalOf(truth, here));
    return truth.visibility[0][there] == truth.visibility[0][here] &&
      truth.coverage[there] == truth.coverage[here] && turn.x + turn.y + turn.z <= 1e-3;
  };
  return !holdsAround({ truth.width, truth.height }, x, y, 2, isLikeHere);
}

struct Planar : PassTest
{
  /// Expect agreement with rays, except at edges: rasterisers move corners by up to 1/256 pixel.
  static void expectLikeRays(
    PassScene& scene, std::size_t leastShadowed = 1000, std::size_t coveredPerWrong = 5000)
  {
    const VisibilityImages truth = drawKept(scene, "raytraced");
    const VisibilityImages& planar = drawKept(scene, "planar");
    const Agreement agreement = compareVisibility(planar, truth);
    const auto isDark = [&](std::size_t i)
    { return truth.coverage[i] > 0.0f && truth.visibility[0][i] == 0.0f; };
    const auto isSpeckle = [&](std::size_t i)
    {
      const int pixel = static_cast<int>(i);
      return std::abs(planar.visibility[0][i] - truth.visibility[0][i]) > 0.5f &&
        !isEdge(truth, pixel % truth.width, pixel / truth.width);
    };
    EXPECT_GE(countPixels(truth, isDark), leastShadowed);
    EXPECT_EQ(countPixels(truth, isSpeckle), 0u);
    EXPECT_LE(agreement.wrong + agreement.coverage, agreement.covered / coveredPerWrong);
  }
};

/// A floor with a box that hangs over it and one of the same height that lies on it: all planes
/// show shadows.
constexpr int boxesPlanes = 11;
void addBoxes(PassScene& scene)
{
  scene.set("planes", "64");
  scene.addFloor(4.0);
  scene.addBox({ -1.0, -1.0, 1.0 }, { 0.5, 0.5, 1.5 });
  scene.addBox({ 1.0, 1.0, 0.0 }, { 2.0, 2.0, 1.0 });
}

std::size_t visible(const VisibilityImages& kept, float visibility, float normalZ)
{
  return countPixels(kept,
    [&](std::size_t i)
    {
      return kept.coverage[i] > 0.0f && kept.normalZ[i] > normalZ &&
        kept.visibility[0][i] == visibility;
    });
}

/// A scene whose planar shadows equal those of rays.
struct PlanarScene
{
  const char* name;
  std::size_t leastShadowed;
  std::function<void(PassScene&)> build;
  int planes = 0; ///< if they are counted
};
std::function<void(PassScene&)> boxesUnderSun(const glm::dvec3& direction)
{
  return [=](PassScene& scene)
  {
    addBoxes(scene);
    scene.addSun(direction);
  };
}
std::function<void(PassScene&)> boxesUnderLamp(const glm::dvec3& position, double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    addBoxes(scene);
    scene.addSpot(position, glm::dvec3(0.0), coneAngleDegrees);
  };
}
/// A light between a box and the floor. Projected through it, the box would be an anti-shadow.
std::function<void(PassScene&)> boxAboveLamp(double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    scene.addFloor(4.0);
    scene.addBox({ -1.0, -1.0, 2.0 }, { 1.0, 1.0, 3.0 });
    scene.addSpot({ 0.2, 0.1, 1.0 }, { 0.2, 0.1, 0.0 }, coneAngleDegrees);
    scene.lookFrom({ 0.0, -9.0, 1.5 });
  };
}
/// A sheet that casts with its front alone, which is up or down.
std::function<void(PassScene&)> oneSidedSheet(double turnDegrees)
{
  return [=](PassScene& scene)
  {
    scene.addFloor(4.0);
    vtkActor* sheet = scene.addFloor(1.0, 0.0);
    sheet->SetPosition(0.0, 0.0, 1.5);
    sheet->RotateX(turnDegrees);
    vtkGnomonPropKeys::SetOneSided(sheet, true);
    scene.addSun({ 0.5, 0.4, -1.0 });
  };
}
void addSheetWithHoles(PassScene& scene)
{
  const auto texture =
    textureOf(makeVeil(4, 4, [](int x, int y) { return (x + 5 * y) % 2 ? 255 : 0; }));
  texture->InterpolateOff();
  scene.addFloor(1.5, 2.0)->SetTexture(texture);
}

const PlanarScene planarScenes[] = {
  { "sun", 1000, boxesUnderSun({ 1.0, 0.4, -1.0 }), boxesPlanes },
  { "spot", 1000, boxesUnderLamp({ -3.0, -2.0, 5.0 }, 35.0), boxesPlanes },
  { "lamp", 1000, boxesUnderLamp({ -1.0, -2.0, 4.0 }, allDirections), boxesPlanes },
  { "sunAlongY", 0, boxesUnderSun({ 0.0, -1.0, 0.0 }) },
  { "sunAlongX", 0, boxesUnderSun({ 1.0, 0.0, 0.0 }) },
  { "sunNearlyAlongX", 0, boxesUnderSun({ 1.0, 0.0, -1e-5 }) },
  { "sunFromBelow", 0, boxesUnderSun({ 0.0, 0.0, 1.0 }) },
  { "sunFromAbove", 0, boxesUnderSun({ 0.0, 0.0, -1.0 }) },
  { "lampBelowItsCaster", 0, boxAboveLamp(allDirections) },
  { "wideSpotBelowItsCaster", 0, boxAboveLamp(80.0) },
  { "oneSidedFront", 1000, oneSidedSheet(0.0) },
  { "oneSidedBack", 0, oneSidedSheet(180.0) },
  // The floor is one plane, and the box has six.
  { "finelyCutAndTurned", 1000,
    [](PassScene& scene)
    {
      scene.add(squareOf(4.0, 0.0, 150))->RotateWXYZ(25.0, 0.3, 0.5, 1.0);
      scene.addBox({ -1.0, -1.0, 1.0 }, { 0.5, 0.5, 1.5 })->RotateWXYZ(25.0, 0.3, 0.5, 1.0);
      scene.addSun({ 0.3, 0.4, -1.0 });
    },
    7 },
  { "fromBelowTheFloor", 20000,
    [](PassScene& scene)
    {
      addBoxes(scene);
      scene.addSun({ 1.0, 0.4, -1.0 });
      scene.lookFrom({ 2.0, -8.0, -7.0 });
    } },
  { "byAParallelCamera", 1000,
    [](PassScene& scene)
    {
      addBoxes(scene);
      scene.addSun({ 1.0, 0.4, -1.0 });
      scene.lookDown(4.5);
    } },
  // The light stands at half the height of one caster.
  { "castersOnBothSidesOfTheLight", 1000,
    [](PassScene& scene)
    {
      scene.addFloor(4.0);
      scene.addBox({ -1.0, -1.0, 0.5 }, { -0.6, 1.0, 3.0 });
      scene.addBox({ 0.8, -0.5, 1.0 }, { 1.0, 0.5, 2.0 });
      scene.addSpot({ 0.0, 0.0, 1.5 }, glm::dvec3(0.0), allDirections);
    } },
  { "lampInThePlane", 1000,
    [](PassScene& scene)
    {
      addBoxes(scene);
      scene.addSpot({ -6.0, -3.0, 0.0 }, { 0.0, 0.0, 0.5 }, allDirections);
      scene.lookFrom({ -5.0, -8.0, 7.0 });
    } },
  { "castersThatStraddleTheFloor", 1000,
    [](PassScene& scene)
    {
      addBoxes(scene);
      scene.addBox({ -1.0, -3.0, -2.0 }, { 0.5, -2.0, 1.0 });
      scene.addBox({ -3.0, 2.0, -2.0 }, { -2.0, 3.0, -0.5 }); // below it
      scene.addSun({ 1.0, 0.4, -1.0 });
    } },
  { "holesOfTextures", 1000,
    [](PassScene& scene)
    {
      scene.addFloor(4.0);
      addSheetWithHoles(scene);
      scene.addSpot({ -1.0, -2.0, 5.0 }, glm::dvec3(0.0), allDirections);
    } },
  { "whatDoesNotReceive", 0,
    [](PassScene& scene)
    {
      vtkGnomonPropKeys::SetReceives(scene.addFloor(4.0), false);
      scene.addBox({ -1.0, -1.0, 1.0 }, { 0.5, 0.5, 1.5 });
      scene.addSun({ 1.0, 0.4, -1.0 });
    } },
};

using PlanarScenes = PassTestOf<PlanarScene, Planar>;

INSTANTIATE_TEST_SUITE_P(All, PlanarScenes, testing::ValuesIn(planarScenes), byName);

} // namespace

TEST_P(PlanarScenes, areWhatRaysSay)
{
  PassScene scene(400, 300);
  scene.lookFrom({ 2.0, -8.0, 7.0 });
  GetParam().build(scene);
  scene.renderer->ResetCameraClippingRange();
  this->expectLikeRays(scene, GetParam().leastShadowed);
  EXPECT_TRUE(GetParam().planes == 0 || scene.report().lights[0].planes == GetParam().planes);
  EXPECT_EQ(scene.report().bvhBuilds + scene.report().mapBakes, 0);
}

TEST_F(Planar, shadowsEndWhereTheirReceiverEnds)
{
  // Two floors, one above the other, and a sphere. The upper floor's shadow must not show on them.
  PassScene scene(400, 400);
  scene.addFloor(1.0, 0.0);
  scene.addFloor(4.0, -2.0);
  scene.addSphere({ 2.5, 2.5, -1.0 }, 1.0);
  scene.addBox({ -3.0, -0.4, 1.0 }, { 3.0, 0.4, 1.2 });
  scene.addSun({ 0.2, 0.5, -1.0 });
  scene.lookFrom({ 1.0, -5.0, 9.0 });
  const VisibilityImages truth = drawKept(scene, "raytraced");
  const VisibilityImages& kept = drawKept(scene, "planar");
  EXPECT_LE(countPixels(kept,
              [&](std::size_t i) { return kept.visibility[0][i] < truth.visibility[0][i] - 0.5f; }),
    20u)
    << "false shadow";
  const Acne onSphere = countAcne(
    kept,
    [](const glm::dvec3& position)
    {
      const bool sphere = glm::distance(position, { 2.5, 2.5, -1.0 }) < 1.01;
      return sphere ? glm::dvec3(-0.2, -0.5, 1.0) : glm::dvec3(0.0);
    },
    0.05);
  EXPECT_GT(onSphere.facing, 500u);
  EXPECT_EQ(onSphere.dark, 0u);
}

TEST_F(Planar, allSixWallsOfARoomShowShadows)
{
  PassScene scene(400, 400);
  scene.addBox({ -4.0, -4.0, -3.0 }, { 4.0, 4.0, 3.0 });
  scene.addSphere({ 1.5, 0.5, 0.0 }, 0.7);
  scene.addBox({ -2.0, 1.0, -3.0 }, { -1.0, 2.0, -1.0 });
  scene.addBox({ -0.2, -0.2, 1.5 }, { 0.2, 0.2, 2.0 });
  scene.addSpot({ 0.0, 0.0, 0.5 }, glm::dvec3(0.0), allDirections);
  scene.set("planes", "64");
  vtkCamera* camera = scene.renderer->GetActiveCamera();
  camera->SetViewAngle(90.0);
  // The boxes' own sides receive shadows, too; self-shadows of the sphere are N.L < 0.
  for (const glm::dvec3& target :
    { glm::dvec3(3.0, 3.0, 1.0), { -3.0, 3.0, -1.0 }, { 0.5, 0.4, 3.0 }, { 0.5, 0.4, -3.0 } })
  {
    scene.lookFrom({ -0.9, -0.8, -0.6 }, target);
    SCOPED_TRACE(testing::Message() << target.x << " " << target.z);
    this->expectLikeRays(scene, 1000, 2000);
    EXPECT_GE(scene.report().lights[0].planes, 6);
  }
}

TEST_F(Planar, noMorePlanesThanAskedForShowShadows)
{
  PassScene scene(300, 300);
  scene.addFloor(3.0);
  scene.addFloor(1.0, 0.5);
  scene.addSphere({ -0.5, 0.0, 1.5 }, 0.4);
  scene.addSun({ 0.5, 0.2, -1.0 });
  scene.lookDown(3.5);
  drawKept(scene, "planar");
  EXPECT_EQ(scene.report().lights[0].planes, 2);
  const auto darkOnUpper = [](const VisibilityImages& kept)
  {
    return countPixels(kept,
      [&](std::size_t i)
      {
        return kept.coverage[i] > 0.0f && std::abs(positionOf(kept, i).z - 0.5) < 0.01 &&
          kept.normalZ[i] > 0.99f && kept.visibility[0][i] == 0.0f;
      });
  };
  EXPECT_GT(darkOnUpper(scene.pass->GetVisibility()), 100u);
  const std::int64_t offBoth = scene.report().lights[0].pixelsOffPlanes;
  EXPECT_GT(offBoth, 500); // the sphere
  ASSERT_EQ(scene.report().notes.size(), 1u);
  EXPECT_THAT(scene.report().notes[0], HasSubstr("2 planes with 9"));

  scene.set("planes", "1");
  const VisibilityImages& one = drawKept(scene);
  EXPECT_EQ(scene.report().lights[0].planes, 1);
  EXPECT_EQ(darkOnUpper(one), 0u) << "the largest plane is the one that is served";
  EXPECT_GT(scene.report().lights[0].pixelsOffPlanes, offBoth + 5000);
}

TEST_F(Planar, planesStayWhenTheCameraMoves)
{
  PassScene scene(160, 120);
  addBoxes(scene);
  scene.addSun({ 1.0, 0.4, -1.0 });
  scene.lookFrom({ 2.0, -8.0, 7.0 });
  scene.render("planar");
  for (int step = 0; step < 12; ++step)
  {
    scene.renderer->GetActiveCamera()->Azimuth(30.0);
    this->expectLikeRays(scene, 0);
    EXPECT_EQ(scene.report().lights[0].planes, boxesPlanes);
  }
}

/// If a receiver's plane cuts a lamp or sun, opposite points replace the points behind the plane,
/// as for rays.
TEST_F(Planar, lightsThatTheirReceiversPlaneCutsAreWhatRaysSay)
{
  for (const int kind : { 0, 1, 2 })
  {
    SCOPED_TRACE(kind);
    PassScene scene(200, 150);
    addBoxes(scene);
    kind == 0     ? scene.addSun({ 1.0, 0.4, -0.2 })
      : kind == 1 ? scene.addSpot({ -3.0, -1.5, 0.5 }, { 0.0, 0.0, 0.5 }, 80.0)
                  : scene.addSpot({ -2.0, -2.0, 0.6 }, glm::dvec3(0.0), allDirections);
    scene.lookFrom({ 2.0, -8.0, 7.0 });
    scene.set("light_radius", kind == 0 ? "40" : "1");
    const std::vector<float> truth = drawKept(scene, "raytraced light_samples=1024").visibility[0];
    EXPECT_GT(countBetween(truth), 500u);
    const VisibilityImages& kept = drawKept(scene, "planar");
    const auto isCovered = [&](std::size_t i) { return kept.coverage[i] > 0.0f; };
    EXPECT_LT(meanDifferenceWhere(kept.visibility[0], truth, 0, isCovered), 0.002);
  }
}

TEST_F(Planar, softShadowsEndExactlyAtDarkAndLit)
{
  PassScene scene(120, 90);
  scene.addFloor(4.0);
  scene.addBox({ -2.0, -2.0, 0.5 }, { 2.0, 2.0, 1.0 });
  scene.addSpot({ 0.0, 0.0, 5.0 }, glm::dvec3(0.0), allDirections);
  scene.lookFrom({ 0.0, -8.0, 3.0 });
  scene.choose("planar light_radius=0.2");
  for (const char* count : { "1", "32", "33", "100", "1024" })
  {
    scene.set("light_samples", count);
    const VisibilityImages& kept = drawKept(scene);
    EXPECT_GT(visible(kept, 1.0f, 0.9f), 300u) << count;
    EXPECT_GT(visible(kept, 0.0f, 0.9f), 200u) << count;
  }
}
