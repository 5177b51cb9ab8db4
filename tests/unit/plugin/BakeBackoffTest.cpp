// When optional maps are baked, over sequences of changing and resting frames.

#include "plugin/plan/BakeBackoff.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

constexpr int least = BakeBackoff::leastPatience;
constexpr int most = BakeBackoff::mostPatience;

/// A light, with counts of its frames and bakes.
struct Light
{
  /// @return true if the frame used a map
  bool draw(bool changes)
  {
    ++this->frames;
    const bool baked = this->hasMap && !changes;
    this->hasMap = this->backoff.usesMap(!changes, baked, this->mayBake);
    this->bakes += this->hasMap && !baked ? 1 : 0;
    return this->hasMap;
  }
  /// Draw one changing frame, then frames in which nothing changes.
  void moveAndRest(int restingFrames)
  {
    this->draw(true);
    for (int frame = 0; frame < restingFrames; ++frame)
    {
      this->draw(false);
    }
  }

  BakeBackoff backoff;
  bool mayBake = true;
  bool hasMap = false;
  int frames = 0;
  int bakes = 0;
};

TEST(BakeBackoff, bakesAfterAsManyRestingFramesInARowAsThePatience)
{
  Light light;
  for (int round = 0; round < 100; ++round)
  {
    light.moveAndRest(least);
  }
  EXPECT_EQ(light.bakes, 0);
  EXPECT_FALSE(light.draw(true));
  EXPECT_THAT(light.backoff.reason(), HasSubstr("after 16 frames without a change (so far 0)"));
  for (int frame = 1; frame <= least; ++frame)
  {
    EXPECT_FALSE(light.draw(false)) << frame;
    EXPECT_THAT(light.backoff.reason(), HasSubstr("(so far " + std::to_string(frame) + ")"));
  }
  for (int frame = 0; frame < 3 * most; ++frame)
  {
    EXPECT_TRUE(light.draw(false));
    EXPECT_EQ(light.backoff.reason(), "");
  }
  EXPECT_EQ(light.bakes, 1);
}

TEST(BakeBackoff, doublesThePatienceWhereMapsServeTooShortlyAndElseHalvesIt)
{
  Light light;
  const auto serve = [&](int patience, int frames)
  {
    EXPECT_EQ(light.backoff.patience(), patience);
    const int before = light.bakes;
    light.moveAndRest(patience + frames);
    EXPECT_EQ(light.bakes, before + 1);
    light.draw(true);
  };
  for (int patience = least; patience <= 4 * most; patience *= 2)
  {
    serve(std::min(patience, most), std::min(patience, most) - 1);
  }
  for (int patience = most; patience > least; patience /= 2)
  {
    serve(patience, patience);
  }
  serve(least, least);
  EXPECT_EQ(light.backoff.patience(), least);
}

TEST(BakeBackoff, countsRestingFramesInWhichNoMapMayBeBaked)
{
  Light light;
  light.mayBake = false;
  light.moveAndRest(2 * most);
  EXPECT_EQ(light.bakes, 0);
  light.mayBake = true;
  EXPECT_TRUE(light.draw(false));
  light.mayBake = false;
  EXPECT_TRUE(light.draw(false)) << "the map is there";
  EXPECT_EQ(light.bakes, 1);
}

/// A map may be there because the pass baked at once earlier.
TEST(BakeBackoff, usesAMapThatIsThere)
{
  BakeBackoff backoff;
  EXPECT_TRUE(backoff.usesMap(false, true, false));
  EXPECT_EQ(backoff.reason(), "");
}

TEST(BakeBackoff, isBoundedOverAnySequence)
{
  std::mt19937 random(1);
  int bakes = 0;
  for (int round = 0; round < 1000; ++round)
  {
    const double mean = std::exp(std::uniform_real_distribution<>(0.0, 6.0)(random));
    std::lognormal_distribution<> rest(
      std::log(mean), std::uniform_real_distribution<>(0.0, 2.0)(random));
    Light light;
    for (int moves = 0; moves < 100; ++moves)
    {
      light.moveAndRest(static_cast<int>(std::min(rest(random), 5000.0)));
      ASSERT_LE(light.bakes, light.frames / (2.0 * least) + 0.5) << round;
    }
    bakes += light.bakes;
  }
  EXPECT_GT(bakes, 10000);
}

} // namespace
} // namespace gnomon::test
