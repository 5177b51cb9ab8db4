// The choices of `auto`, as a function of facts, history and evidence.

#include "plugin/plan/AutoPlan.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace gnomon
{
namespace
{

using testing::HasSubstr;
using Way = AutoChoice::Way;

/// A light that leaves its technique to the pass, in a scene whose rays take long.
struct AutoPlans : testing::Test
{
  AutoPlans()
  {
    this->map_.info.evaluation = Evaluation::Pointwise;
    this->rays_.info.evaluation = Evaluation::ScreenCpu;
    this->light.mapSizeTexels = 1024;
    this->light.lightSamples = 64;
    this->scene.lights.compose = [this](ShadowLight asked)
    {
      const bool isMap = asked.technique == plainTechnique;
      return Composition{ asked, isMap ? &this->map_ : &this->rays_, {} };
    };
    this->picture.moves = true;
    this->scene.props.casters = { 1, 1 };
    this->picture.pixels = 1024 * 1024;
    this->picture.factors = defaultFactors(true);
  }

  void addArea(double radius)
  {
    this->light.area = ballArea(radius);
    this->light.kind = LightKind::Point;
  }

  /// Plan a frame in which the camera moves. The history goes on with it once it is complete.
  AutoPlan plan(const std::vector<Evidence>& evidence = {})
  {
    LightPlan resting;
    resting.light = this->light;
    resting.estimator = &this->rays_;
    resting.identity = identityOf(this->light);
    resting.asked = &this->light;
    resting.mostMapTexels = this->mostMapTexels;
    ++this->picture.view;
    AutoPlan planned = planAuto(this->scene, { resting }, this->wishes, this->history, evidence);
    if (!planned.needs)
    {
      this->history = planned.history;
    }
    return planned;
  }
  /// Plan a frame whose needs are answered alike.
  AutoPlan planWith(const Evidence& evidence)
  {
    std::vector<Evidence> all;
    AutoPlan planned = this->plan(all);
    while (planned.needs)
    {
      this->asked.push_back(*planned.needs);
      all.push_back(evidence);
      planned = this->plan(all);
    }
    return planned;
  }

  static Evidence ofMap(std::size_t asked, std::size_t wrong)
  {
    Evidence evidence;
    evidence.probe = { { asked, wrong }, 8 };
    evidence.isClear = true;
    return evidence;
  }

  ShadowLight light;
  int mostMapTexels = 16384;
  Scene scene;
  ScenePicture& picture = this->scene.picture;
  FrameWishes wishes;
  AutoHistory history;
  std::vector<EvidenceRequest> asked;

private:
  EstimatorEntry map_, rays_;
};

} // namespace

TEST_F(AutoPlans, restingPicturesAreExact)
{
  this->picture.moves = false;
  const AutoPlan planned = this->plan();
  ASSERT_FALSE(planned.needs);
  EXPECT_EQ(planned.choices.at(0).way, Way::Resting);
  EXPECT_THAT(planned.choice, HasSubstr("rests: exact"));
}

TEST_F(AutoPlans, motionsAfterARestProveTheirChoicesAgain)
{
  for (const std::size_t wrong : { 0, 3000 })
  {
    SCOPED_TRACE(wrong > 0 ? "maps wait" : "a map is proved");
    this->picture.moves = true;
    this->planWith(ofMap(30000, wrong));
    EXPECT_FALSE(this->plan().needs);
    EXPECT_GT(wrong > 0 ? this->history.byRays : this->history.byMaps, 0);
    this->history.lights.at(0).probe.looks = 3; // of a proof that had not ended
    this->picture.moves = false;
    this->plan();
    EXPECT_EQ(this->history.byRays + this->history.byMaps + this->history.patience, 0);
    this->picture.moves = true;
    const AutoPlan planned = this->plan();
    ASSERT_TRUE(planned.needs);
    EXPECT_EQ(planned.needs->before.looks, 0);
  }
}

TEST_F(AutoPlans, mapsAreProvedBeforeTheyAreShown)
{
  const AutoPlan first = this->plan();
  ASSERT_TRUE(first.needs);
  EXPECT_EQ(first.needs->mapSizeTexels, 1024);
  EXPECT_EQ(first.needs->errorLimit, this->wishes.maximumError);
  EXPECT_FALSE(first.needs->isShown);
  const AutoPlan planned = this->planWith(ofMap(30000, 0));
  EXPECT_EQ(planned.choices.at(0).way, Way::Map);
  EXPECT_EQ(planned.choices.at(0).mapSizeTexels, 1024);
  for (int frame = 1; frame < 16; ++frame)
  {
    EXPECT_FALSE(this->plan().needs) << "proved for 16 frames";
  }
  EXPECT_TRUE(this->plan().needs);
}

// A moving frame by rays took 30 ms, 20 of them for the light's image; by maps 15.
TEST_F(AutoPlans, aTimeBudgetIsComparedWithWhatFramesTook)
{
  this->history.times.restByRays = 10.0;
  this->history.times.restByMaps = 15.0;
  this->history.times.sample[this->light.sceneIndex] = 20.0;
  const AutoHistory before = this->history;
  struct Case
  {
    double budget;
    int framesByMaps;
    Way way;
    bool isKept;
  };
  for (const Case& one : { Case{ 31.0, 0, Way::Resting, true }, Case{ 29.0, 0, Way::Map, true },
         Case{ 14.0, 0, Way::Map, false }, Case{ 40.0, 10, Way::Map, true },
         Case{ 34.0, 40, Way::Map, true }, Case{ 40.0, 40, Way::Resting, true } })
  {
    this->history = before;
    this->history.byMaps = one.framesByMaps;
    this->wishes.timeBudget = one.budget;
    const AutoPlan planned = this->planWith(ofMap(30000, 0));
    EXPECT_EQ(planned.choices.at(0).way, one.way) << one.budget << " " << planned.choice;
    EXPECT_EQ(planned.choice.find("the time budget is not kept") == std::string::npos, one.isKept)
      << one.budget << " " << planned.choice;
  }
}

TEST_F(AutoPlans, mapsGrowAndThenRaysAreTaken)
{
  const AutoPlan planned = this->planWith(ofMap(30000, 3000));
  std::vector<int> sides;
  for (const EvidenceRequest& request : this->asked)
  {
    sides.push_back(request.mapSizeTexels);
  }
  EXPECT_EQ(sides, (std::vector{ 1024, 4096 })) << "a tenth is wrong, twenty times the limit";
  EXPECT_EQ(planned.choices.at(0).way, Way::Resting);
  EXPECT_THAT(planned.choice, HasSubstr("3000 are wrong with a map of 4096 texels"));
  for (int frame = 1; frame < 30; ++frame)
  {
    EXPECT_FALSE(this->plan().needs) << "maps wait";
  }
  EXPECT_TRUE(this->plan().needs);
}

TEST_F(AutoPlans, mapsAreTriedSoonIfRaysAreLate)
{
  struct Case
  {
    double budget;
    int waits; ///< frames
  };
  for (const Case& one : { Case{ 5.0, 8 }, Case{ 1e6, 30 } })
  {
    this->history = {};
    this->wishes.timeBudget = one.budget;
    this->history.times.add(true, 10.0 * one.budget); // so maps are tried, in vain
    this->planWith(ofMap(30000, 3000));
    this->history.times.restByRays = 50.0;
    for (int frame = 1; frame < one.waits; ++frame)
    {
      EXPECT_FALSE(this->plan().needs) << one.budget << " " << frame;
    }
    EXPECT_EQ(this->plan().needs.has_value(), one.budget < 50.0) << one.budget;
  }
}

TEST_F(AutoPlans, evidenceThatFailsMeansRays)
{
  Evidence evidence;
  evidence.failure = "there is no memory";
  const AutoPlan planned = this->planWith(evidence);
  EXPECT_EQ(planned.choices.at(0).way, Way::Resting);
  EXPECT_THAT(planned.choice, HasSubstr("rays, as there is no memory"));
}

TEST_F(AutoPlans, probesGoOnInTheNextFrameWhileAMapIsShown)
{
  this->planWith(ofMap(30000, 0));
  for (int frame = 1; frame < 16; ++frame)
  {
    this->plan();
  }
  Evidence unclear = ofMap(4000, 20);
  unclear.isClear = false;
  const AutoPlan planned = this->planWith(unclear);
  EXPECT_EQ(planned.choices.at(0).way, Way::Map);
  EXPECT_TRUE(this->asked.back().isShown);
  const AutoPlan next = this->plan();
  ASSERT_TRUE(next.needs);
  EXPECT_EQ(next.needs->before.found.asked, 4000u);
}

TEST_F(AutoPlans, factsThatForbidMapsAreNamed)
{
  const auto reason = [this] { return this->plan().choice; };
  this->picture.severalViews = true;
  EXPECT_THAT(reason(), HasSubstr("several views"));
  this->picture.severalViews = false;
  this->scene.props.unseenReceiver = true;
  EXPECT_THAT(reason(), HasSubstr("probes miss it"));
  this->scene.props.unseenReceiver = false;
  this->wishes.keepVisibility = true;
  EXPECT_THAT(reason(), HasSubstr("is kept"));
  this->wishes.keepVisibility = false;
  this->wishes.route = RouteWish::Image;
  EXPECT_THAT(reason(), HasSubstr("route is asked for"));
  this->wishes.route = RouteWish::Auto;
  this->wishes.maximumError = 0.0;
  EXPECT_THAT(reason(), HasSubstr("as small as the limit"));
  this->wishes.maximumError = 0.005;
  this->mostMapTexels = 512;
  EXPECT_THAT(reason(), HasSubstr("memory budget"));
}

TEST_F(AutoPlans, areaLightsTakeTheFewestSamplesThatKeepTheError)
{
  this->addArea(0.5);
  std::vector<Evidence> evidence;
  std::vector<int> samples;
  AutoPlan planned = this->plan(evidence);
  while (planned.needs)
  {
    samples.push_back(planned.needs->lightSamples);
    evidence.emplace_back().keepsError = planned.needs->lightSamples == 8;
    planned = this->plan(evidence);
  }
  EXPECT_EQ(samples, (std::vector{ 0, 4, 6, 8 }));
  EXPECT_EQ(planned.choices.at(0).lightSamples, 8);

  this->picture.moves = false;
  this->picture.mayRefine = true;
  EXPECT_EQ(this->plan().choices.at(0).firstSamples, 8);
}

TEST_F(AutoPlans, areaLightsKeepAllSamplesWithoutAnError)
{
  this->addArea(0.5);
  this->wishes.maximumSoftError = 0.0;
  const AutoPlan planned = this->plan();
  ASSERT_FALSE(planned.needs);
  EXPECT_EQ(planned.choices.at(0).way, Way::Resting);
  EXPECT_EQ(planned.choices.at(0).lightSamples, 0);
}

TEST_F(AutoPlans, areaLightsThatGrowAreProvedAnew)
{
  this->addArea(0.1);
  Evidence evidence;
  evidence.keepsError = true;
  EXPECT_EQ(this->planWith(evidence).choices.at(0).way, Way::Centre);
  this->addArea(0.105);
  EXPECT_FALSE(this->plan().needs) << "hardly larger";
  this->addArea(0.2);
  EXPECT_TRUE(this->plan().needs);
}

TEST_F(AutoPlans, raysThatAreNearlyAsFastReplaceMaps)
{
  this->history.lights[0].tracedShare = 0.0;
  this->plan(); // notes the request
  this->history.lights[0].tracedShare = 0.0;
  this->picture.factors.tracePixel = 0.0;
  this->picture.factors.receiverPixel = 0.0;
  this->picture.factors.fetchPixel = 0.0;
  const AutoPlan planned = this->plan();
  ASSERT_FALSE(planned.needs);
  EXPECT_THAT(planned.choice, HasSubstr("nearly as little time"));
}

TEST_F(AutoPlans, theWindowsTimeLimitsSamples)
{
  this->addArea(1.0);
  this->wishes.windowTime = 100.0;
  Evidence fails;
  fails.keepsError = false;
  EXPECT_EQ(this->planWith(fails).choices.at(0).lightSamples, 64) << "nothing is known of times";
  struct Row
  {
    double sample, rest;
    Way way;
    int samples;
  };
  for (const Row& row : { Row{ 1.0, 20.0, Way::Resting, 64 }, Row{ 2.0, 20.0, Way::Resting, 35 },
         Row{ 5.0, 70.0, Way::Resting, 4 }, Row{ 10.0, 70.0, Way::Centre, 0 },
         Row{ 50.0, 200.0, Way::Centre, 0 } })
  {
    this->history = {};
    this->history.times.sample[this->light.sceneIndex] = row.sample;
    this->history.times.restByRays = row.rest;
    const AutoChoice choice = this->planWith(fails).choices.at(0);
    EXPECT_EQ(choice.way, row.way) << row.sample;
    EXPECT_EQ(choice.lightSamples, row.samples) << row.sample;
  }
  this->wishes.windowTime = 0.0;
  EXPECT_EQ(this->planWith(fails).choices.at(0).lightSamples, 64) << "no rate is asked for";
}

} // namespace gnomon
