// When maps that only save time are drawn and kept: what that takes, over sequences of frames whose times are given.

#include "plugin/MapCost.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace gnomon::test
{
namespace
{

using Plan = MapCost::Plan;
using Situation = MapCost::Situation;
using testing::HasSubstr;

/// What the stages of a frame take, in milliseconds.
struct Times
{
  double traced = 1.0;
  double mapped = 0.5;
  double map = 8.0;
};

/// A light, and what it took so far.
class Light
{
public:
  explicit Light(const Times& itsTimes)
    : times(itsTimes)
  {
  }

  Plan draw(bool changes)
  {
    this->hasMap_ &= !changes;
    const Plan plan = this->cost.plan(changes ? Situation::Changed
        : this->hasMap_                       ? Situation::Mapped
                                              : Situation::Still,
      this->picturePixels);
    double visibility = this->times.traced;
    if (plan == Plan::Draw)
    {
      ++this->maps;
      this->total += this->times.map;
      this->cost.mapTook(this->times.map);
    }
    if (plan == Plan::Draw || plan == Plan::Use)
    {
      visibility = this->times.mapped;
    }
    this->hasMap_ = plan != Plan::Trace && plan != Plan::Drop;
    visibility *= this->disturbance();
    this->total += visibility;
    this->cost.visibilityTook(visibility);
    return plan;
  }
  /// A change, and frames in which nothing does.
  void moveAndRest(int stillFrames)
  {
    this->draw(true);
    for (int frame = 0; frame < stillFrames; ++frame)
    {
      this->draw(false);
    }
  }

  Times times;
  glm::ivec2 picturePixels{ 512 };
  std::function<double()> disturbance = [] { return 1.0; };
  MapCost cost;
  double total = 0.0;
  int maps = 0;

private:
  bool hasMap_ = false;
};

/// What the same frames take where all is traced.
double tracingAll(const Times& times, const std::vector<int>& stillFrames)
{
  double total = 0.0;
  for (const int frames : stillFrames)
  {
    total += times.traced * (1 + frames);
  }
  return total;
}

/// And where a map is drawn whenever nothing has changed for a frame.
double drawingAtOnce(const Times& times, const std::vector<int>& stillFrames)
{
  double total = 0.0;
  for (const int frames : stillFrames)
  {
    total += times.traced + (frames > 0 ? times.map : 0.0) + frames * times.mapped;
  }
  return total;
}

Light drawn(const Times& times, const std::vector<int>& stillFrames)
{
  Light light(times);
  for (const int frames : stillFrames)
  {
    light.moveAndRest(frames);
  }
  return light;
}

TEST(MapCost, hasTheFirstMapDrawnOnceNothingHasChanged)
{
  Light light({ 1.0, 0.5, 8.0 });
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(light.draw(true), Plan::Trace);
    EXPECT_THAT(light.cost.reason(), HasSubstr("drawn once nothing has changed for a frame"));
  }
  EXPECT_EQ(light.draw(false), Plan::Draw);
  EXPECT_EQ(light.draw(false), Plan::Use);
  EXPECT_EQ(light.cost.reason(), "");
}

TEST(MapCost, hasFurtherOnesDrawnAfterTracingForAsLong)
{
  Light light({ 1.0, 1.0, 8.0 });
  light.moveAndRest(1);
  EXPECT_EQ(light.maps, 1); // which saved nothing, so that two are to be paid for
  EXPECT_EQ(light.draw(true), Plan::Trace);
  EXPECT_THAT(light.cost.reason(),
    HasSubstr("taken 16 ms in frames in which nothing changes (so far 0.00 ms)"));
  for (int frame = 0; frame < 16; ++frame)
  {
    EXPECT_EQ(light.draw(false), Plan::Trace) << frame;
    EXPECT_THAT(light.cost.reason(), HasSubstr("so far " + std::to_string(frame + 1)));
  }
  EXPECT_EQ(light.draw(false), Plan::Draw);
}

/// A map saves in proportion to what is seen.
TEST(MapCost, isEarnedByWhatTheCameraSees)
{
  Light light({ 1.0, 0.5, 8.0 });
  light.moveAndRest(1); // saves 0.5
  light.disturbance = [] { return 0.1; };
  for (int frame = 0; frame < 12; ++frame)
  {
    light.draw(false); // 0.05
  }
  light.draw(true);
  EXPECT_THAT(light.cost.reason(), HasSubstr("taken 15 ms"));
}

TEST(MapCost, ofALightThatAlwaysMovesIsNone)
{
  EXPECT_EQ(drawn({}, std::vector<int>(1000, 0)).maps, 0);
}

TEST(MapCost, ofALightThatMovesInEverySecondFrameIsOneMap)
{
  const std::vector<int> moves(500, 1);
  for (const double map : { 2.0, 8.0, 30.0 })
  {
    const Times times{ 1.0, 0.2, map };
    const Light light = drawn(times, moves);
    EXPECT_EQ(light.maps, 1);
    EXPECT_NEAR(light.total, tracingAll(times, moves) + map - 0.8, 1e-9);
    EXPECT_GT(drawingAtOnce(times, moves), 1.5 * light.total);
  }
}

/// Maps that pay are drawn at once after a while, and others no more.
TEST(MapCost, ofALightThatMovesInEveryTenthFrameIsThatOfTheBetterWay)
{
  const std::vector<int> moves(200, 9);
  for (const double map : { 0.5, 2.0, 4.0, 8.0, 30.0 })
  {
    const Times times{ 1.0, 0.2, map };
    const Light light = drawn(times, moves);
    const double best = std::min(tracingAll(times, moves), drawingAtOnce(times, moves));
    EXPECT_LT(light.total, 1.1 * best) << map;
  }
}

TEST(MapCost, ofALightThatRestsIsOneMap)
{
  const Times times{ 1.0, 0.2, 30.0 };
  const Light light = drawn(times, { 1000 });
  EXPECT_EQ(light.maps, 1);
  // It is compared in two frames, as it plainly pays.
  EXPECT_NEAR(light.total, drawingAtOnce(times, { 1000 }) + 2 * 0.8, 1e-9);
}

/// How long lights rest, of all kinds: hardly ever, always alike, now short and now long.
std::vector<int> randomRests(std::mt19937& random)
{
  const double mean = std::exp(std::uniform_real_distribution<>(-1.0, 6.0)(random));
  const double spread = std::uniform_real_distribution<>(0.0, 2.0)(random);
  std::lognormal_distribution<> rest(std::log(mean), spread);
  std::vector<int> rests(std::uniform_int_distribution<>(1, 200)(random));
  std::generate(
    rests.begin(), rests.end(), [&] { return static_cast<int>(std::min(rest(random), 2000.0)); });
  return rests;
}

TEST(MapCost, isBoundedOverAnySequence)
{
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round)
  {
    const std::vector<int> rests = randomRests(random);
    const Times times{ 1.0, std::uniform_real_distribution<>(0.0, 1.0)(random),
      std::exp(std::uniform_real_distribution<>(-2.0, 5.0)(random)) };
    const Light light = drawn(times, rests);
    ASSERT_LE(
      light.total, 1.1 * tracingAll(times, rests) + MapCost::mostDebtMaps * times.map + 1e-6)
      << round;
    ASSERT_LE(light.total, 11.0 * drawingAtOnce(times, rests) + 1e-6) << round;
  }
}

/// The worst that can happen: the light moves whenever a map was drawn.
TEST(MapCost, isBoundedForALightThatMovesWheneverItsMapIsDrawn)
{
  Light light({ 1.0, 0.9, 8.0 });
  const int frames = 20000;
  bool wasDrawn = true;
  for (int frame = 0; frame < frames; ++frame)
  {
    wasDrawn = light.draw(wasDrawn) == Plan::Draw;
  }
  EXPECT_GT(light.maps, 100);
  EXPECT_LE(light.total, 1.1 * frames + MapCost::mostDebtMaps * 8.0);
}

TEST(MapCost, givesUpAMapThatDoesNotPay)
{
  Light light({ 12.25, 12.5, 30.0 });
  light.moveAndRest(10000);
  EXPECT_EQ(light.maps, 1);
  EXPECT_LT(light.total, 12.25 * 10001 + 30.0 + 0.25 * 23);
  EXPECT_THAT(
    light.cost.reason(), HasSubstr("with it visibility took 12 ms, and without it 12 ms"));

  // After a change it has another chance, when what it cost and is to cost was spent on tracing.
  light.moveAndRest(4);
  EXPECT_EQ(light.maps, 1);
  light.times.mapped = 5.0;
  light.moveAndRest(100);
  EXPECT_EQ(light.maps, 2);
  EXPECT_EQ(light.cost.reason(), "");
}

TEST(MapCost, givesAMapAnotherChanceInAnotherPicture)
{
  Light light({ 1.0, 1.0, 30.0 });
  light.moveAndRest(1000);
  EXPECT_EQ(light.maps, 1);
  EXPECT_THAT(light.cost.reason(), HasSubstr("does not pay"));
  Light larger = light;
  larger.picturePixels *= 2;
  larger.times = { 1.5, 0.75, 30.0 };
  Light elsewhere = light; // the camera sees more
  elsewhere.times = { 4.0, 1.0, 30.0 };
  for (int frame = 0; frame < 100; ++frame)
  {
    larger.draw(false);
    elsewhere.draw(false);
  }
  EXPECT_EQ(larger.maps, 2);
  EXPECT_EQ(elsewhere.maps, 2);
  EXPECT_EQ(larger.cost.reason(), "");
}

/// Nothing is seen, and nothing takes time.
TEST(MapCost, isNoMatterWhereNothingTakesTime)
{
  Light light({ 0.0, 0.0, 0.0 });
  light.moveAndRest(100);
  light.times = { 1.0, 0.5, 8.0 };
  const int before = light.maps;
  for (int move = 0; move < 100; ++move)
  {
    light.moveAndRest(1);
  }
  EXPECT_LE(light.maps, before + 1);
}

/// Other programs' work makes frames longer, some of them much.
TEST(MapCost, isJudgedInSpiteOfNoise)
{
  std::mt19937 random(2);
  const auto disturbed = [&](double noise)
  {
    return [&random, noise]
    {
      const bool delayed = std::bernoulli_distribution(0.1)(random);
      return std::uniform_real_distribution<>(1.0, delayed ? 4.0 : 1.0 + noise)(random);
    };
  };
  int kept = 0, givenUp = 0;
  for (int round = 0; round < 1000; ++round)
  {
    Light paying({ 1.0, 0.7, 8.0 });
    paying.disturbance = disturbed(0.2);
    paying.moveAndRest(100);
    kept += paying.cost.reason().empty() ? 1 : 0;
    Light costly({ 1.0, 1.02, 8.0 });
    costly.disturbance = disturbed(0.05);
    costly.moveAndRest(100);
    givenUp += costly.cost.reason().empty() ? 0 : 1;
  }
  EXPECT_GT(kept, 980);
  EXPECT_GT(givenUp, 950);
}

/// What the camera sees makes frames longer by as much, with the map and without.
TEST(MapCost, isJudgedWhileTheCameraMoves)
{
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round)
  {
    double seen = 1.0;
    const auto walks = [&random, &seen]
    { return seen *= std::exp(std::normal_distribution<>(0.0, 0.05)(random)); };
    Light paying({ 1.0, 0.7, 8.0 });
    paying.disturbance = walks;
    paying.moveAndRest(200);
    EXPECT_EQ(paying.cost.reason(), "") << round;
    Light costly({ 1.0, 1.15, 1e9 });
    costly.disturbance = walks;
    costly.moveAndRest(60);
    EXPECT_THAT(costly.cost.reason(), HasSubstr("does not pay")) << round;
  }
}

} // namespace
} // namespace gnomon::test
