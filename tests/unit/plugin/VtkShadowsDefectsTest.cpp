// Cases where VTK's own vtkShadowMapPass is wrong and `nsm` is right, besides users' wishes
// (WishesTest.cpp). Each test draws both and compares them with the exact shadow: a box over a
// floor, seen from straight above.

#include "PassScene.h"

#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>

using namespace gnomon::test;

namespace
{

class VtkShadowsDefects : public PassTest
{
};

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
TEST_F(VtkShadowsDefects, mapSizeChangedAlone)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(hangingBox.lower, hangingBox.upper);
  scene.addSun({ 1.0, 0.3, -1.0 }); // oblique to the texels, so edges show them
  scene.lookDown(10.0);

  const Picture fine = scene.render();
  scene.pass->SetMapSize(32);
  const Picture coarse = scene.render();
  EXPECT_EQ(scene.report().mapBakes, 1);
  EXPECT_GT(differingPixels(fine, coarse, 64), 100u);

  scene.useVtkShadows(1024);
  const Picture fineVtk = scene.render();
  vtkShadowMapPass::SafeDownCast(scene.vtkShadows)->GetShadowMapBakerPass()->SetResolution(32);
  EXPECT_EQ(differingPixels(fineVtk, scene.render()), 0u); // VTK's pass ignores the resolution
}

//------------------------------------------------------------------------------
TEST_F(VtkShadowsDefects, severalLightsWithOneSwitchedOffBetweenThem)
{
  PassScene scene(300, 300);
  scene.addFloor(10.0);
  scene.addBox(standingBox.lower, standingBox.upper);
  const std::vector<glm::dvec3> directions = { { 1.0, 0.0, -1.0 }, { -1.0, -1.0, -1.0 } };
  scene.addSun(directions[0])->SetIntensity(0.5);
  scene.addSun({ 0.0, 1.0, -1.0 })->SwitchOff();
  scene.addSun(directions[1])->SetIntensity(0.5);
  scene.lookDown(5.0);
  const ExactFloor exact = floorUnderHalfSuns(standingBox, directions);

  EXPECT_EQ(checkFloor(scene, scene.render(), exact, 0.12).wrong(), 0u);
  scene.useVtkShadows();
  EXPECT_GT(checkFloor(scene, scene.render(), exact, 0.12).wrong(), 500u);
}
