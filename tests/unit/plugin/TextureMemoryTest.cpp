// Maps and images that no memory is left for: an error that says so, a picture without shadows, and
// nothing broken.

#include "LiveObjects.h"
#include "PassScene.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

using namespace gnomon::test;
using testing::AllOf;
using testing::HasSubstr;

namespace
{

/// 6 layers of 1 GiB, for which software OpenGL has no room at all.
constexpr int hugeMap = 16384;

using TextureMemory = PassTest;

void fillRoundLamp(PassScene& scene)
{
  scene.addSphereOverFloor();
  for (const glm::dvec3& place : { glm::dvec3(0.0, 0.0, 6.0), { 3.0, 0.0, 3.5 }, { -3.0, 0.0, 3.5 },
         { 0.0, 3.0, 3.5 }, { 0.0, -3.0, 3.5 } })
  {
    scene.addSphere(place, 0.7);
  }
  scene.addSpot({ 0.0, 0.0, 3.5 }, glm::dvec3(0.0), 90.0);
}

/// Maps of a technique.
struct MapsOf
{
  const char* name;
  const char* settings;
  int route = vtkGnomonShadowPass::ROUTE_AUTO;
  /// The rest of the error; anything where that depends on which of several images has no room.
  const char* asks = "";
};
using MapsWithoutRoom = PassTestOf<MapsOf, TextureMemory>;

constexpr const char* sixDepths =
  " in 6 layers needs 6442 MB of texture memory, which is not available; ";
constexpr const char* sixOnCpu = " in 6 layers needs 33822 MB of memory, which is not available; ";

INSTANTIATE_TEST_SUITE_P(TextureMemory, MapsWithoutRoom,
  testing::Values(MapsOf{ "depthsInline", "nsm", vtkGnomonShadowPass::ROUTE_INLINE, sixDepths },
    MapsOf{ "depthsByTheImage", "nsm", vtkGnomonShadowPass::ROUTE_IMAGE, sixDepths },
    MapsOf{ "momentsBlurred", "vsm blur=box mip_maps=off" },
    MapsOf{ "momentsSummed", "vsm blur=sat mip_maps=off" },
    MapsOf{ "momentsInMipMaps", "vsm blur=box mip_maps=on" },
    MapsOf{ "depthLayers", "montecarlo light_radius=0.2" },
    MapsOf{ "cellsOnTheCpu", "crsm", vtkGnomonShadowPass::ROUTE_AUTO, sixOnCpu }),
  byName);

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

/// An error in the first frame, no shadows in any, and all as it was before once the maps have room
/// again.
TEST_P(MapsWithoutRoom, areAnErrorThatOffersSmallerOnesAndLeaveNothingBehind)
{
  PassScene scene(100, 80);
  fillRoundLamp(scene);
  scene.usePlain();
  const Picture plain = scene.render();
  if (isOnGpu())
  {
    GTEST_SKIP() << "a GPU may have room for the map";
  }
  scene.useGnomon();
  scene.choose(GetParam().settings);
  scene.pass->SetRoute(GetParam().route);
  scene.pass->SetMapSize(64);
  const Picture shadowed = scene.render();
  EXPECT_GT(differingPixels(plain, shadowed), 100u);
  for (int frame = 0; frame < 5; ++frame)
  {
    scene.render(); // VTK compiles other shaders at rest
  }
  const LiveObjects live = countLiveObjects(scene.window);

  scene.pass->SetMapSize(hugeMap);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_EQ(differingPixels(plain, scene.render()), 0u);
    const std::string error = this->takeErrors();
    if (frame > 0)
    {
      EXPECT_EQ(error, "") << "said once";
    }
    else
    {
      EXPECT_THAT(error,
        AllOf(HasSubstr(std::string("drawn without shadows: light 0: a map of 16384 x 16384") +
                GetParam().asks),
          HasSubstr("is not available; "), HasSubstr(" fits")));
    }
    EXPECT_TRUE(scene.report().outOfTextureMemory);
    EXPECT_EQ(scene.report().route, "none");
  }

  scene.pass->SetMapSize(64);
  EXPECT_EQ(differingPixels(shadowed, scene.render()), 0u);
  EXPECT_FALSE(scene.report().outOfTextureMemory);
  EXPECT_EQ(countLiveObjects(scene.window), live);
}

/// The centre's map has room, those of the light's other points have none when the picture is
/// drawn.
TEST_F(TextureMemory, mapsThatAreDrawnWithThePictureNameTheirLight)
{
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a program whose address space ends";
#endif
  PassScene scene(100, 80);
  scene.addSphereOverFloor();
  scene.addSun({ 0.3, 0.3, -1.0 });
  set(scene.addSun({ -0.3, 0.3, -1.0 }), "technique", "sampled");
  const Picture coarse = scene.render("light_radius=5 map_size=64");
  {
    const AddressSpace scarce(300u << 20);
    scene.pass->SetMapSize(4096); // 67 MB, ten of them
    scene.render();
  }
  EXPECT_THAT(this->takeErrors(), HasSubstr("light 1: a map of 4096 x 4096 needs 67 MB"));
  EXPECT_TRUE(scene.report().outOfTextureMemory);
  scene.pass->SetMapSize(64);
  EXPECT_EQ(differingPixels(coarse, scene.render()), 0u);
}
