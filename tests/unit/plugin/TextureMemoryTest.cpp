// Maps and images that no memory is left for: an error that says so, a picture without shadows, and
// nothing broken.

#include "LiveObjects.h"
#include "PassScene.h"

#include "lights/vtkGnomonLightKeys.h"

#include <vtkLightCollection.h>

#include <gmock/gmock.h>

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

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

/// Leaves this process so much address space beside what it has, in bytes, for as long as it lives.
class AddressSpace
{
public:
  explicit AddressSpace(rlim_t more)
  {
    getrlimit(RLIMIT_AS, &this->before_);
    std::ifstream file("/proc/self/statm");
    rlim_t pages = 0;
    file >> pages;
    rlimit limit = this->before_;
    limit.rlim_cur = pages * static_cast<rlim_t>(getpagesize()) + more;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~AddressSpace() { setrlimit(RLIMIT_AS, &this->before_); }
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;

private:
  rlimit before_{};
};

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
TEST_F(TextureMemory, mapsOfMomentsWithoutRoomLeaveNothingBehind)
{
  PassScene scene(100, 80);
  fill(scene);
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();
  scene.pass->SetTechnique("vsm");
  for (const char* kind : { "box", "sat", "mip_maps" })
  {
    const bool mipMaps = std::string(kind) == "mip_maps";
    scene.pass->SetSetting("blur", mipMaps ? "box" : kind);
    scene.pass->SetSetting("mip_maps", mipMaps ? "on" : "off");
    scene.pass->SetMapSize(64);
    const Picture shadowed = scene.render();
    EXPECT_GT(differingPixels(plain, shadowed), 100u);
    const LiveObjects live = countLiveObjects(scene.window);

    scene.pass->SetMapSize(hugeMap);
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    EXPECT_THAT(this->takeErrors(),
      AllOf(HasSubstr("light 0: a map of 16384 x 16384"), HasSubstr("cannot be had")))
      << kind;

    scene.pass->SetMapSize(64);
    EXPECT_EQ(differingPixels(shadowed, scene.render()), 0u);
    EXPECT_EQ(countLiveObjects(scene.window), live) << kind;
  }
}

//------------------------------------------------------------------------------
TEST_F(TextureMemory, depthLayersWithoutRoomLeaveNothingBehind)
{
  PassScene scene(100, 80);
  fill(scene);
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();
  scene.pass->SetTechnique("montecarlo");
  scene.pass->SetSetting("light_radius", "0.2");
  for (const char* pyramid : { "mips", "nbuffer" })
  {
    scene.pass->SetSetting("mc_pyramid", pyramid);
    scene.pass->SetMapSize(64);
    const Picture shadowed = scene.render();
    EXPECT_GT(differingPixels(plain, shadowed), 100u);
    const LiveObjects live = countLiveObjects(scene.window);

    scene.pass->SetMapSize(hugeMap);
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    EXPECT_THAT(this->takeErrors(),
      AllOf(HasSubstr("drawn without shadows: light 0: a map of 16384 x 16384"),
        HasSubstr("cannot be had; one of ")))
      << pyramid;
    EXPECT_TRUE(scene.report().outOfTextureMemory);
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    EXPECT_THAT(this->takeErrors(), HasSubstr("cannot be had")) << "the next frame, too";

    scene.pass->SetMapSize(64);
    EXPECT_EQ(differingPixels(shadowed, scene.render()), 0u);
    EXPECT_EQ(countLiveObjects(scene.window), live) << pyramid;
  }
}

//------------------------------------------------------------------------------
TEST_F(TextureMemory, mapsOnTheCpuWithoutRoomAreAnErrorThatOffersSmallerOnes)
{
  PassScene scene(100, 80);
  fill(scene);
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();
  scene.pass->SetTechnique("crsm");
  scene.pass->SetMapSize(64);
  const Picture shadowed = scene.render();
  EXPECT_GT(differingPixels(plain, shadowed), 100u);

  scene.pass->SetMapSize(hugeMap); // 6 of 4 GiB
  EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
  EXPECT_THAT(this->takeErrors(),
    AllOf(
      HasSubstr("light 0: a map of 16384 x 16384 in 6 layers asks for 33822 MB of memory, which "
                "cannot be had; one of "),
      HasSubstr(" can")));
  EXPECT_TRUE(scene.report().outOfTextureMemory);

  scene.pass->SetMapSize(64);
  EXPECT_EQ(differingPixels(shadowed, scene.render()), 0u);
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

//------------------------------------------------------------------------------
/// The centre's map has room, those of the light's other points have none when the picture is drawn.
TEST_F(TextureMemory, mapsThatAreDrawnWithThePictureNameTheirLight)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a program whose address space ends";
#endif
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  scene.addSun({ 0.3, 0.3, -1.0 });
  vtkGnomonLightKeys::SetSetting(scene.addSun({ -0.3, 0.3, -1.0 }), "technique", "sampled");
  scene.pass->SetSetting("light_radius", "5");
  scene.pass->SetMapSize(64);
  const Picture coarse = scene.render();
  {
    const AddressSpace scarce(300u << 20);
    scene.pass->SetMapSize(4096); // 67 MB, ten of them
    scene.render();
  }
  EXPECT_THAT(this->takeErrors(), HasSubstr("light 1: a map of 4096 x 4096 asks for 67 MB"));
  EXPECT_TRUE(scene.report().outOfTextureMemory);
  scene.pass->SetMapSize(64);
  EXPECT_EQ(differingPixels(coarse, scene.render()), 0u);
}

//------------------------------------------------------------------------------
/// Each of the maps has room alone, and not all of them together.
TEST_F(TextureMemory, mapsThatHaveNoRoomTogetherAreAnErrorThatNamesTheFirstLightWithout)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a program whose address space ends";
#endif
  constexpr int large = 4096; // 67 MB
  constexpr int lights = 8;
  PassScene scene(100, 80);
  scene.addFloor(4.0);
  scene.addSphere({ 0.0, 0.0, 1.5 }, 0.7);
  scene.lookFrom({ 0.0, -9.0, 7.0 });
  for (int i = 0; i < lights; ++i)
  {
    scene.addSun({ 0.2 * i - 0.8, 0.3, -1.0 })->SetIntensity(0.1);
  }
  scene.usePlain();
  const Picture plain = scene.render();
  scene.useGnomon();
  scene.pass->SetMapSize(64);
  const Picture coarse = scene.render();
  EXPECT_GT(differingPixels(plain, coarse), 100u);
  const LiveObjects live = countLiveObjects(scene.window);
  {
    const AddressSpace scarce(300u << 20);
    scene.pass->SetMapSize(large);
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
  }
  const std::string errors = this->takeErrors();
  EXPECT_THAT(errors, testing::ContainsRegex("light [1-7]: a map of 4096 x 4096 asks for 67 MB"));
  EXPECT_THAT(errors, HasSubstr("cannot be had; one of "));
  EXPECT_TRUE(scene.report().outOfTextureMemory);

  scene.pass->SetMapSize(64);
  EXPECT_EQ(differingPixels(coarse, scene.render()), 0u);
  EXPECT_EQ(countLiveObjects(scene.window), live);
}
