// The quality of hard shadow maps of all projections, with their default settings: no acne, no
// detached shadows, and no view that breaks them.

#include "DegenerateViews.h"
#include "LitPlane.h"
#include "MapLayout.h"
#include "PassScene.h"

#include "plugin/VisibilityImages.h"
#include "plugin/vtkGnomonPropKeys.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

class HardMaps
  : public PassTest
  , public testing::WithParamInterface<MapLayout>
{
protected:
  static void choose(PassScene& scene) { GetParam().choose(scene); }
  static double coneUpTo(double degrees)
  {
    return GetParam().takesCubes() ? degrees : std::min(degrees, 60.0);
  }
};

INSTANTIATE_TEST_SUITE_P(Layouts, HardMaps,
  testing::Values(MapLayout{ "nsm" }, MapLayout{ "nsm", "technique", "frame", "off" },
    MapLayout{ "nsm", "technique", "frame" }, MapLayout{ "lispsm" }, MapLayout{ "tsm" },
    MapLayout{ "pssm", "technique", "off", "off" }, MapLayout{ "pssm" }),
  testing::PrintToStringParamName());

} // namespace

//------------------------------------------------------------------------------
TEST_P(HardMaps, litPlaneHasNoAcneAtAnyAngle)
{
  expectNoAcneUnderTheSun([](PassScene& scene, vtkLight*) { choose(scene); },
    { 0.0, 5.0, 30.0, 45.0, 60.0, 75.0, 85.0, 88.0, 89.0 });
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, longPlaneHasNoAcne)
{
  expectNoAcneAlongALongPlane(
    [](PassScene& scene, vtkLight*) { choose(scene); }, { 0.0, 5.0, 60.0, 85.0, 89.0 });
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, litPlaneHasNoAcneUnderASpotLight)
{
  expectNoAcneUnderASpot(
    [](PassScene& scene, vtkLight*) { choose(scene); }, { this->coneUpTo(80.0) });
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, sphereHasNoAcne)
{
  PassScene scene(300, 300);
  this->choose(scene);
  scene.addSphere(glm::dvec3(0.0), 1.0);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.lookFrom({ -2.0, -2.0, 3.0 });
  for (const int mapSize : { 64, 256, 1024 })
  {
    scene.pass->SetMapSize(mapSize);
    // The sphere is convex: all that faces the light is lit. Within a texel of the terminator, the
    // map cannot tell.
    const Acne acne = countAcneOfSun(drawKept(scene), { -1.0, -0.4, 1.5 }, 4.0 / mapSize + 0.05);
    EXPECT_GT(acne.facing, 20000u);
    EXPECT_EQ(acne.dark, 0u) << "map " << mapSize;
  }
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, shadowsTouchTheirCasters)
{
  // A wall on a floor, seen from above; its shadow begins at x = 0.1 and must do so within a texel.
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
    // The floor's extent across the light, and how long a texel's footprint on the floor is.
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

//------------------------------------------------------------------------------
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
  std::size_t shadow = 0;
  for (std::size_t i = 0; i < traced.coverage.size(); ++i)
  {
    shadow +=
      traced.coverage[i] > 0.0f && traced.normalZ[i] > 0.9f && traced.visibility[0][i] == 0.0f ? 1
                                                                                               : 0;
  }
  EXPECT_GT(shadow, 150u);
  EXPECT_LE(agreement.wrong, shadow / 2);
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, receiversThatDoNotCastMayLieBehindAllCasters)
{
  for (const bool spot : { false, true })
  {
    PassScene scene(300, 300);
    this->choose(scene);
    vtkGnomonPropKeys::SetCasts(scene.addFloor(4.0), false);
    scene.addSphere({ -1.0, 0.0, 2.5 }, 0.7);
    spot ? scene.addSpot({ -2.0, 0.0, 5.0 }, glm::dvec3(0.0), 50.0)
         : scene.addSun({ 1.0, 0.4, -1.5 });
    scene.lookFrom({ 0.0, -9.0, 7.0 });
    const VisibilityImages mapped = drawKept(scene);
    scene.pass->SetTechnique("raytraced");
    const Agreement agreement = compareVisibility(mapped, drawKept(scene));
    EXPECT_GT(agreement.covered, 20000u);
    EXPECT_LE(agreement.wrong, 40u) << "spot: " << spot; // the map's square has empty corners
  }
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, litPlaneHasNoAcneFromFarAway)
{
  PassScene scene(200, 200);
  this->choose(scene);
  scene.addFloor(4.0);
  scene.addSun({ 0.0, 0.0, -1.0 });
  for (const double distance : { 10.0, 100.0, 1000.0 })
  {
    scene.lookFrom({ 0.1 * distance, -0.5 * distance, distance });
    scene.renderer->GetActiveCamera()->SetViewAngle(2.0 * glm::degrees(std::atan(5.0 / distance)));
    const Acne acne = countAcneOfSun(drawKept(scene), { 0.0, 0.0, 1.0 });
    EXPECT_GT(acne.facing, 10000u);
    EXPECT_EQ(acne.dark, 0u) << "from " << distance;
  }
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, degenerateViewsStayFinite)
{
  // The narrowest and widest of cones, too.
  drawDegenerateViews(
    { 1.0, 45.0, this->coneUpTo(89.0) }, [](PassScene&, vtkLight*) {},
    [](PassScene& scene)
    {
      scene.pass->SetTechnique("raytraced");
      drawKept(scene);
      choose(scene);
      drawByBothRoutes(scene);
    });
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, sceneWithoutPropsOrCastersIsLit)
{
  PassScene scene(64, 48);
  this->choose(scene);
  scene.addSun({ 1.0, 0.4, -1.5 });
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  EXPECT_EQ(differingPixels(scene.render(), scene.render()), 0u);
  scene.pass->SetTechnique("raytraced");
  scene.render();
}

//------------------------------------------------------------------------------
TEST_P(HardMaps, singleTriangleAndFlatSceneAreLit)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1.0, -1.0, 0.0);
  points->InsertNextPoint(1.0, -1.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[3] = { 0, 1, 2 };
  cells->InsertNextCell(3, corners);
  vtkNew<vtkPolyData> triangle;
  triangle->SetPoints(points);
  triangle->SetPolys(cells);
  for (const int mapSize : { 16, 1024 })
  {
    for (const glm::dvec3& direction :
      { glm::dvec3(0.0, 0.0, -1.0), { 1.0, 0.4, -1.5 }, { 1.0, 0.0, -0.02 } })
    {
      PassScene scene(200, 150);
      this->choose(scene);
      scene.add(triangle);
      scene.addSun(direction);
      scene.pass->SetMapSize(mapSize);
      scene.lookFrom({ 0.0, -4.0, 4.0 });
      const Acne acne = countAcneOfSun(drawKept(scene), -direction);
      EXPECT_GT(acne.facing, 1000u);
      EXPECT_EQ(acne.dark, 0u) << "map " << mapSize << ", towards " << direction.x;
    }
  }
}

//------------------------------------------------------------------------------
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
