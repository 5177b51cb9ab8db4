// Hundreds of changes must leave nothing behind. The number of live OpenGL objects stays the same.
// Resident memory grows by less than 1.5 MB from the first half of the changes to the second: 125
// leaks of 12 kB would grow that much. The longest loops also run without the pass, to separate the
// memory of VTK and the driver.

#include "LiveObjects.h"
#include "PassScene.h"

#include "plugin/vtkGnomonLightSamplingPass.h"

#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace gnomon::test
{
namespace
{

constexpr int warmUp = 50;
constexpr int manyTimes = 250;
constexpr double mostGrowthMegabytes = 1.5;

/// Return this process's memory that is in use and not swapped out, in megabytes. Earlier cases
/// leave free memory in malloc, which would hide a leak, so it is returned first.
double residentMegabytes()
{
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  long all = 0;
  long resident = 0;
  file >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

struct SmallScene : SunAndSpotScene
{
  SmallScene()
    : SunAndSpotScene(40, 30)
  {
    this->pass->SetMapSize(128);
  }
};

/// Objects and memory left by many repetitions.
struct LeftBehind
{
  LiveObjects before;
  LiveObjects after;
  double growthMegabytes = 0.0;
};

/// Repeat an action, and compare live objects after the first few times and at the end. Memory
/// varies by megabytes with the number of threads that build the tracer. A leak raises both the
/// minimum and the maximum of the second half over those of the first, so the smaller rise counts.
LeftBehind repeat(vtkRenderWindow* window, int times, const std::function<void(int)>& action)
{
  for (int time = 0; time < warmUp; ++time)
  {
    action(time);
  }
  LeftBehind left;
  left.before = countLiveObjects(window);
  const auto residentOverHalf = [&](int first, int end)
  {
    double least = std::numeric_limits<double>::max();
    double most = 0.0;
    for (int time = first; time < end; ++time)
    {
      action(time);
      const double resident = residentMegabytes();
      least = std::min(least, resident);
      most = std::max(most, resident);
    }
    return glm::dvec2(least, most);
  };
  const glm::dvec2 before = residentOverHalf(0, times / 2);
  const glm::dvec2 growth = residentOverHalf(times / 2, times) - before;
  left.growthMegabytes = std::min(growth.x, growth.y);
  left.after = countLiveObjects(window);
  return left;
}

void expectNothingLeftBehind(const LeftBehind& left)
{
  EXPECT_GT(left.before.at("textures"), 0);
  EXPECT_EQ(left.after, left.before);
  EXPECT_LT(left.growthMegabytes, mostGrowthMegabytes);
}

/// Expect the memory growth with the pass to be near that of plain VTK in the same loop.
void expectNoMoreThanPlainVtk(const LeftBehind& left, const LeftBehind& plain)
{
  EXPECT_EQ(plain.after, plain.before) << "VTK's own";
  EXPECT_LT(left.growthMegabytes - plain.growthMegabytes, mostGrowthMegabytes);
}

struct LifeCycle : PassTestOf<Way>
{
  LifeCycle() { this->scene_.choose(GetParam()); }
  void draw() { this->scene_.window->Render(); }

  SmallScene scene_;
};

INSTANTIATE_TEST_SUITE_P(Ways, LifeCycle, fewWays, nameOf);
INSTANTIATE_TEST_SUITE_P(OnPlanes, LifeCycle, testing::Values(planarWay), nameOf);
INSTANTIATE_TEST_SUITE_P(ThroughLayers, LifeCycle, testing::Values(layersWay), nameOf);

} // namespace

TEST_P(LifeCycle, changesManyTimes)
{
  vtkLight* const sun = lightOf(this->scene_.renderer, 0);
  vtkLight* const spot = lightOf(this->scene_.renderer, 1);
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetDelegatePass(this->scene_.pass);
  sampling->SetSamples(4);
  struct Loop
  {
    const char* name;
    int times;
    std::function<void(int time)> action;
  };
  const Loop loops[] = {
    { "lights off and on", manyTimes,
      [&](int time)
      {
        const bool on = time % 2 == 1;
        sun->SetSwitch(on);
        this->draw();
        spot->SetShadowAttenuation(on ? 1.0f : 0.0f); // 0: its shadows remove no light
        this->draw();
      } },
    { "maps of other sizes", manyTimes,
      [&](int time)
      {
        this->scene_.pass->SetMapSize(16 + 8 * (time % 10));
        this->draw();
      } },
    { "resources released", 100,
      [&](int)
      {
        this->scene_.pass->ReleaseGraphicsResources(this->scene_.window);
        this->draw();
      } },
    { "lights sampled", 100,
      [&](int time)
      {
        this->scene_.renderer->SetPass(sampling);
        sampling->SetSamplesPerFrame(time % 10 < 5 ? 2 : 0);
        set(spot, "light_radius", time % 7 < 3 ? "0" : "0.5");
        this->scene_.window->SetSize(20 + 7 * (time % 5), 30);
        this->draw();
      } },
  };
  for (const Loop& loop : loops)
  {
    SCOPED_TRACE(loop.name);
    expectNothingLeftBehind(repeat(this->scene_.window, loop.times, loop.action));
  }
  const bool bakes = findTechnique(GetParam().technique)->estimator->info.bakesMap();
  EXPECT_EQ(this->takeErrors().empty(), bakes) << "that there is no map to size";
}

/// The longest loops, beside plain VTK's.
TEST_P(LifeCycle, passSwitchedAndWindowResizedManyTimes)
{
  const auto loop = [this](bool shadows)
  {
    return repeat(this->scene_.window, manyTimes,
      [&](int time)
      {
        this->scene_.usePlain();
        this->draw();
        this->scene_.renderer->SetPass(shadows ? this->scene_.pass.Get() : nullptr);
        this->draw();
        this->scene_.window->SetSize(20 + 7 * time % 41, 20 + 11 * time % 31);
        this->draw();
      });
  };
  const LeftBehind left = loop(true);
  expectNothingLeftBehind(left);
  EXPECT_EQ(this->scene_.report().lights.size(), 2u);
  expectNoMoreThanPlainVtk(left, loop(false));
}

TEST_P(LifeCycle, passMovedToAnotherWindowAndBackManyTimes)
{
  SmallScene other;
  const Picture picture = this->scene_.render();
  expectNothingLeftBehind(repeat(this->scene_.window, 100,
    [&](int)
    {
      this->scene_.usePlain();
      other.renderer->SetPass(this->scene_.pass);
      other.window->Render();
      other.usePlain();
      this->scene_.useGnomon();
      this->draw();
    }));
  EXPECT_EQ(differingPixels(picture, this->scene_.render()), 0u);
  this->scene_.usePlain();
  other.renderer->SetPass(this->scene_.pass);
  EXPECT_EQ(differingPixels(picture, other.render()), 0u) << "by objects of the other window";
}

TEST_P(LifeCycle, lightSamplingReleasesEverything)
{
  set(lightOf(this->scene_.renderer, 1), "light_radius", "0.5");
  this->scene_.usePlain();
  this->draw();
  const LiveObjects plain = withoutPrograms(countLiveObjects(this->scene_.window));
  Picture picture;
  {
    vtkNew<vtkGnomonLightSamplingPass> sampling;
    sampling->SetDelegatePass(this->scene_.pass);
    sampling->SetSamples(4);
    this->scene_.renderer->SetPass(sampling);
    picture = this->scene_.render();
    EXPECT_NE(withoutPrograms(countLiveObjects(this->scene_.window)), plain);
    sampling->ReleaseGraphicsResources(this->scene_.window);
    EXPECT_EQ(withoutPrograms(countLiveObjects(this->scene_.window)), plain) << "after the release";
    EXPECT_EQ(picture, this->scene_.render()) << "drawn again after the release";
    this->scene_.usePlain();
  }
  // The pass may be deleted before its window, and may move to another window.
  EXPECT_EQ(withoutPrograms(countLiveObjects(this->scene_.window)), plain);
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetSamples(4);
  for (int time = 0; time < 3; ++time)
  {
    SmallScene other;
    set(lightOf(other.renderer, 1), "light_radius", "0.5");
    other.choose(GetParam());
    sampling->SetDelegatePass(other.pass);
    other.renderer->SetPass(sampling);
    EXPECT_EQ(other.render(), picture);
  }
}

} // namespace gnomon::test
