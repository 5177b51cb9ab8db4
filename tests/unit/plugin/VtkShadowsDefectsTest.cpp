// Where VTK's own vtkShadowMapPass is wrong and `nsm` is right. Each test draws both and holds them
// against the exact shadow: a box over a floor, seen from straight above.

#include "PassScene.h"

#include <vtkCubeSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>

#include <cmath>

using namespace gnomon::test;

namespace
{

class VtkShadowsDefects : public PassTest
{
};

/// Stands on the floor; its shadow is x in [1, 3].
const Box standing{ { -1.0, -1.0, 0.0 }, { 1.0, 1.0, 2.0 } };

constexpr double texels = 3.0; ///< left out beside the shadow's edge

} // namespace

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, bothAreRightInASquareWindow)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(hangingBox.lower, hangingBox.upper);
  scene.addSun(slantingSun);
  scene.lookDown(10.0);
  const ExactFloor exact = floorUnderSun(hangingBox, 10.0);
  const double band = texels * 24.0 / 1024.0 + 20.0 / 300.0;

  const FloorCheck nsm = checkFloor(scene, scene.render(), exact, band);
  EXPECT_GT(nsm.counted, 70000u);
  EXPECT_EQ(nsm.wrong(), 0u);
  scene.useVtkShadows();
  EXPECT_LE(checkFloor(scene, scene.render(), exact, band).wrong(), 0.001 * nsm.counted);
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, windowThatIsNotSquare)
{
  PassScene scene(450, 225);
  scene.addFloor(10.0);
  scene.addBox(hangingBox.lower, hangingBox.upper);
  scene.addSun(slantingSun);
  scene.lookDown(5.0);
  const ExactFloor exact = floorUnderSun(hangingBox, 10.0);
  const double band = texels * 24.0 / 1024.0 + 10.0 / 225.0;

  EXPECT_EQ(checkFloor(scene, scene.render(), exact, band).wrong(), 0u);
  scene.useVtkShadows();
  const FloorCheck vtk = checkFloor(scene, scene.render(), exact, band);
  EXPECT_GT(vtk.falseLight, 500u); // the shadow ends too early
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, contactOnABigFloor)
{
  PassScene scene(300, 300);
  scene.addFloor(100.0);
  scene.addBox(standing.lower, standing.upper);
  scene.addSun(slantingSun);
  scene.lookDown(4.0);
  const ExactFloor exact = floorUnderSun(standing, 100.0);
  const double band = texels * 200.0 / 4096.0;

  scene.pass->SetMapSize(4096);
  EXPECT_EQ(checkFloor(scene, scene.render(), exact, band).wrong(), 0u);
  scene.useVtkShadows(4096);
  const FloorCheck vtk = checkFloor(scene, scene.render(), exact, band);
  EXPECT_GT(vtk.falseLight, 2000u); // all of the shadow's inside is lit by half or more
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, casterOutsideTheView)
{
  PassScene scene(300, 300);
  scene.addFloor(100.0);
  scene.addBox(standing.lower, standing.upper);
  scene.addSun(slantingSun);
  const ExactFloor exact = floorUnderSun(standing, 100.0);
  const double band = texels * 200.0 / 4096.0;

  // The point (2.2, 0) of the umbra, seen with the caster in view, and as the first thing without
  // it.
  const auto withCaster = [&]
  {
    scene.lookDown(1.0, 1.5);
    return scene.render().red(255, 150);
  };
  const auto withoutCaster = [&]
  {
    scene.lookDown(0.5, 2.4); // the box's bounding sphere ends at 1.73
    return scene.render().red(90, 150);
  };
  scene.pass->SetMapSize(4096);
  EXPECT_EQ(withCaster(), 0);
  EXPECT_EQ(withoutCaster(), 0);
  EXPECT_EQ(checkFloor(scene, scene.render(), exact, band).wrong(), 0u);
  scene.useVtkShadows(4096);
  const int vtkWithCaster = withCaster();
  scene.useVtkShadows(4096);
  EXPECT_GT(std::abs(vtkWithCaster - withoutCaster()), 60); // the same shadow, another darkness
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, lightThatIsSwitchedOffBeforeTheCastingOne)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(hangingBox.lower, hangingBox.upper);
  scene.addSun({ 0.0, 1.0, -1.0 })->SwitchOff();
  scene.addSun(slantingSun);
  scene.lookDown(10.0);
  const ExactFloor exact = floorUnderSun(hangingBox, 10.0);

  EXPECT_EQ(checkFloor(scene, scene.render(), exact, 0.14).wrong(), 0u);
  scene.useVtkShadows();
  EXPECT_GT(checkFloor(scene, scene.render(), exact, 0.14).falseLight, 1000u);
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, verticesEditedInPlace)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  vtkNew<vtkCubeSource> source;
  source->SetBounds(-1.0, 1.0, -1.0, 1.0, 1.0, 3.0);
  source->Update();
  vtkNew<vtkPolyData> box;
  box->DeepCopy(source->GetOutput());
  scene.add(box);
  scene.addSun(slantingSun);
  scene.lookDown(10.0);
  const auto moveBy = [&](double x)
  {
    for (vtkIdType i = 0; i < box->GetNumberOfPoints(); ++i)
    {
      double point[3];
      box->GetPoint(i, point);
      box->GetPoints()->SetPoint(i, point[0] + x, point[1], point[2]);
    }
    box->GetPoints()->Modified();
    box->Modified();
  };
  const Box moved{ hangingBox.lower - glm::dvec3(3.0, 0.0, 0.0),
    hangingBox.upper - glm::dvec3(3.0, 0.0, 0.0) };
  const ExactFloor exact = floorUnderSun(hangingBox, 10.0);
  const ExactFloor exactMoved = floorUnderSun(moved, 10.0);

  EXPECT_EQ(checkFloor(scene, scene.render(), exact, 0.14).wrong(), 0u);
  moveBy(-3.0);
  EXPECT_EQ(checkFloor(scene, scene.render(), exactMoved, 0.14).wrong(), 0u);

  moveBy(3.0);
  scene.useVtkShadows();
  scene.render();
  moveBy(-3.0);
  const FloorCheck vtk = checkFloor(scene, scene.render(), exactMoved, 0.14);
  EXPECT_GT(vtk.falseLight, 500u);  // the new shadow is missing
  EXPECT_GT(vtk.falseShadow, 500u); // the old one is still there
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, mapSizeChangedAlone)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(hangingBox.lower, hangingBox.upper);
  scene.addSun({ 1.0, 0.3, -1.0 }); // oblique to the texels, so that edges show them
  scene.lookDown(10.0);

  const Picture fine = scene.render();
  scene.pass->SetMapSize(32);
  const Picture coarse = scene.render();
  EXPECT_EQ(scene.report().mapBakes, 1);
  EXPECT_GT(differingPixels(fine, coarse, 64), 100u);

  scene.useVtkShadows(1024);
  const Picture fineVtk = scene.render();
  vtkShadowMapPass::SafeDownCast(scene.vtkShadows)->GetShadowMapBakerPass()->SetResolution(32);
  EXPECT_EQ(differingPixels(fineVtk, scene.render()), 0u); // as if nothing had been asked for
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, physicallyBasedShadingUnderASpotLight)
{
  PassScene scene(300, 300);
  for (vtkActor* actor : { scene.addFloor(10.0), scene.addBox(standing.lower, standing.upper) })
  {
    actor->GetProperty()->SetInterpolationToPBR();
    actor->GetProperty()->SetRoughness(1.0);
  }
  const glm::dvec3 position(-6.0, 0.0, 8.0);
  scene.addSpot(position, glm::dvec3(0.0), 60.0)->SetIntensity(10.0);
  scene.lookDown(4.0);
  const auto inShadow = [&](const glm::dvec2& floor)
  { return hitsBox(floor, position - glm::dvec3(floor, 0.0), standing.lower, standing.upper); };
  // Brightness falls off with the distance: ask only for black, and not black.
  const auto exactOrBright = [&](const Picture& picture, int x, int y)
  { return picture.red(x, y) > 64 ? 1.0 : 0.0; };
  const auto wrong = [&](const Picture& picture)
  {
    std::size_t count = 0;
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        const glm::dvec2 floor = scene.floorAt(x, y);
        const bool shadow = inShadow(floor);
        const bool edge = shadow != inShadow(floor * 1.02) || shadow != inShadow(floor * 0.98) ||
          shadow != inShadow(floor + glm::dvec2(0.0, 0.08)) ||
          shadow != inShadow(floor - glm::dvec2(0.0, 0.08));
        // The box and its picture's border are not the floor.
        if (!edge && (std::abs(floor.x) > 1.05 || std::abs(floor.y) > 1.05))
        {
          count += exactOrBright(picture, x, y) != (shadow ? 0.0 : 1.0) ? 1 : 0;
        }
      }
    }
    return count;
  };

  EXPECT_EQ(wrong(scene.render()), 0u);
  scene.useVtkShadows();
  EXPECT_GT(wrong(scene.render()), 3000u); // no shadow at all
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, severalLightsWithOneSwitchedOffBetweenThem)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(standing.lower, standing.upper);
  const std::array<glm::dvec3, 2> directions = { { { 1.0, 0.0, -1.0 }, { -1.0, -1.0, -1.0 } } };
  scene.addSun(directions[0])->SetIntensity(0.5);
  scene.addSun({ 0.0, 1.0, -1.0 })->SwitchOff();
  scene.addSun(directions[1])->SetIntensity(0.5);
  scene.lookDown(5.0);
  const ExactFloor exact = [&](const glm::dvec2& floor)
  {
    double value = isUnder(floor, standing) ? -1.0 : 0.0;
    for (const glm::dvec3& direction : directions)
    {
      const bool lit = !hitsBox(floor, -direction, standing.lower, standing.upper);
      value += value >= 0.0 && lit ? 127.5 / glm::length(direction) : 0.0;
    }
    return value;
  };

  EXPECT_EQ(checkFloor(scene, scene.render(), exact, 0.12).wrong(), 0u);
  scene.useVtkShadows();
  EXPECT_GT(checkFloor(scene, scene.render(), exact, 0.12).wrong(), 500u);
}
