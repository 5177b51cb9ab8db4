// Maps and images that no memory is left for: an error that says so, a picture without shadows, and
// nothing broken.

#include "LiveObjects.h"
#include "PassScene.h"

#include "lights/vtkGnomonLightKeys.h"

#include <vtkLightCollection.h>

#include <gmock/gmock.h>

using namespace gnomon::test;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

/// 6 layers of 1 GiB, for which software OpenGL has no room at all, and a GPU seldom.
constexpr int hugeMap = 16384;

class TextureMemory : public PassTest
{
};

void fill(PassScene& scene)
{
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.addSphere({ 0.0, 0.0, 6.0 }, 0.7);
  scene.addSphere({ 3.0, 0.0, 3.5 }, 0.7);
  scene.addSphere({ -3.0, 0.0, 3.5 }, 0.7);
  scene.addSphere({ 0.0, 3.0, 3.5 }, 0.7);
  scene.addSphere({ 0.0, -3.0, 3.5 }, 0.7);
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetConeAngle(90.0);
  lamp->SetPosition(0.0, 0.0, 3.5);
  scene.renderer->AddLight(lamp);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
}

} // namespace

//------------------------------------------------------------------------------
TEST_F(TextureMemory, mapsWithoutRoomAreAnErrorThatOffersSmallerOnes)
{
  for (const int route : { vtkGnomonShadowPass::ROUTE_INLINE, vtkGnomonShadowPass::ROUTE_IMAGE })
  {
    PassScene scene(100, 80);
    fill(scene);
    scene.usePlain();
    const Picture plain = scene.render();
    scene.useGnomon();
    scene.choose({ "nsm", route });
    const Picture shadowed = scene.render();
    EXPECT_GT(differingPixels(plain, shadowed), 100u);
    const LiveObjects live = countLiveObjects(scene.window);

    scene.pass->SetMapSize(hugeMap);
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    EXPECT_THAT(this->takeErrors(),
      AllOf(HasSubstr("drawn without shadows: light 0: a map of 16384 x 16384 in 6 layers asks for "
                      "6442 MB of texture memory, which cannot be had; one of "),
        HasSubstr(" can")));
    EXPECT_TRUE(scene.report().outOfTextureMemory);
    EXPECT_EQ(scene.report().route, "none");
    scene.render();
    EXPECT_THAT(this->takeErrors(), HasSubstr("cannot be had")) << "the next frame, too";

    scene.pass->SetMapSize(1024);
    EXPECT_EQ(differingPixels(shadowed, scene.render()), 0u);
    EXPECT_FALSE(scene.report().outOfTextureMemory);
    EXPECT_EQ(countLiveObjects(scene.window), live);
  }
}

//------------------------------------------------------------------------------
TEST_F(TextureMemory, oneLightOfSeveralIsNamed)
{
  PassScene scene(100, 80);
  scene.addSun({ 1.0, 0.3, -1.5 });
  fill(scene);
  vtkGnomonLightKeys::SetMapSize(
    vtkLight::SafeDownCast(scene.renderer->GetLights()->GetItemAsObject(1)), hugeMap);
  scene.render();
  EXPECT_THAT(this->takeErrors(), HasSubstr("light 1: a map"));
}
