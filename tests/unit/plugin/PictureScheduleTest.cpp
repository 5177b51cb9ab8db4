// When further pictures are due: sequences of frames, buttons and timers against orders.

#include "plugin/plan/PictureSchedule.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

enum class Event
{
  Moving,     ///< a fast frame of a changed scene, which a picture at rest may differ from
  Same,       ///< a fast frame of the same scene as before
  Exact,      ///< a fast frame of a changed scene, which a picture at rest equals
  Resting,    ///< a finished frame at rest
  Few,        ///< a frame at rest that shows a quarter of the points
  More,       ///< a frame at rest that shows half of them
  RefineNext, ///< asks whether the next frame at rest may be unfinished
  Press,
  Release,
  StartInteraction,
  Own,   ///< the timer that waits fires
  Other, ///< another timer fires
  Fail   ///< the timer could not be started
};

/// A moment, what happens then, and the order that must follow: "", "start 500", "stop", "draw".
struct Step
{
  double at; ///< milliseconds
  Event event;
  std::string order = "";
  bool acts = false; ///< true if an interactor style acts
};

struct Sequence
{
  const char* name;
  std::vector<Step> steps;
};

std::string textOf(const TimerOrder& order)
{
  switch (order.kind)
  {
    case TimerOrder::Kind::Start:
      return "start " + std::to_string(order.milliseconds);
    case TimerOrder::Kind::Stop:
      return "stop";
    case TimerOrder::Kind::Draw:
      return "draw";
    default:
      return "";
  }
}

/// A frame of a window that asks for speed.
TimerOrder fastFrame(PictureSchedule& schedule, const Step& step, bool changed, bool mayDiffer)
{
  const bool moves = schedule.moves(changed, step.at);
  return schedule.drawn({ moves, moves && mayDiffer, 1.0 }, step.acts, step.at);
}

TimerOrder take(PictureSchedule& schedule, const Step& step)
{
  switch (step.event)
  {
    case Event::Moving:
      return fastFrame(schedule, step, true, true);
    case Event::Same:
      return fastFrame(schedule, step, false, true);
    case Event::Exact:
      return fastFrame(schedule, step, true, false);
    case Event::Resting:
      return schedule.drawn({}, step.acts, step.at);
    case Event::Few:
      return schedule.drawn({ false, false, 0.25 }, step.acts, step.at);
    case Event::More:
      return schedule.drawn({ false, false, 0.5 }, step.acts, step.at);
    case Event::RefineNext:
      return schedule.mayRefine() ? schedule.refine(step.at) : TimerOrder{};
    case Event::Press:
      return schedule.pressed();
    case Event::Release:
      return schedule.released(step.at);
    case Event::StartInteraction:
      return schedule.interacts();
    case Event::Own:
      schedule.fired();
      return schedule.timerEvent(step.acts, step.at);
    case Event::Other:
      return schedule.timerEvent(step.acts, step.at);
    default:
      schedule.failed();
      return {};
  }
}

using PictureScheduleTest = testing::TestWithParam<Sequence>;

TEST_P(PictureScheduleTest, orders)
{
  PictureSchedule schedule;
  for (const Step& step : GetParam().steps)
  {
    EXPECT_EQ(textOf(take(schedule, step)), step.order) << "at " << step.at;
  }
}

using E = Event;
constexpr bool acts = true;

INSTANTIATE_TEST_SUITE_P(All, PictureScheduleTest,
  testing::Values(
    Sequence{ "restFollowsMotion",
      { { 0, E::Moving, "start 500" }, { 500, E::Own, "draw" }, { 510, E::Resting } } },
    Sequence{ "oneTimerWaitsForManyFrames",
      { { 0, E::Moving, "start 500" }, { 200, E::Moving }, { 400, E::Moving },
        { 500, E::Own, "start 400" }, { 900, E::Own, "draw" }, { 910, E::Resting } } },
    Sequence{ "aProgramsOwnFrameCounts",
      { { 0, E::Moving, "start 500" }, { 100, E::Resting }, { 500, E::Own } } },
    Sequence{ "anotherTimerMayDraw",
      { { 0, E::Moving, "start 500" }, { 400, E::Other }, { 505, E::Other, "draw" },
        { 510, E::Resting }, { 511, E::Own } } },
    Sequence{ "exactMotionNeedsNoRest", { { 0, E::Exact }, { 600, E::Other } } },
    Sequence{ "aRateLeftHighIsRest",
      { { 0, E::Moving, "start 500" }, { 400, E::Same }, { 500, E::Own, "draw" }, { 501, E::Same },
        { 502, E::Other } } },
    Sequence{ "nothingIsScheduledInADrag",
      { { 0, E::Press }, { 10, E::Moving, "", acts }, { 20, E::Moving, "", acts },
        { 2000, E::Other, "", acts }, { 3000, E::Release, "start 1" }, { 3000, E::Resting },
        { 3001, E::Own } } },
    Sequence{ "aDragOfAWidgetIsHeld",
      { { 0, E::Press }, { 10, E::Moving }, { 2000, E::Other }, { 3000, E::Release, "start 1" },
        { 3001, E::Own, "draw" }, { 3010, E::Resting } } },
    Sequence{ "aPressStopsTheTimer",
      { { 0, E::Moving, "start 500" }, { 100, E::Press, "stop" }, { 110, E::Moving, "", acts },
        { 300, E::Release, "start 310" }, { 610, E::Own, "draw" } } },
    Sequence{ "aStylesStartStopsTheTimer",
      { { 0, E::Moving, "start 500" }, { 100, E::StartInteraction, "stop" },
        { 101, E::Moving, "", acts }, { 150, E::Resting } } },
    Sequence{ "aTimerThatFiredIsNotStopped",
      { { 0, E::Moving, "start 500" }, { 500, E::Own, "draw" }, { 501, E::Press } } },
    Sequence{ "unfinishedPicturesFollowAtOnce",
      { { 0, E::Few, "start 1" }, { 1, E::Own, "draw" }, { 2, E::More, "start 1" },
        { 3, E::Own, "draw" }, { 4, E::Resting }, { 5, E::Other } } },
    Sequence{ "unfinishedPicturesWaitForTheDragsEnd",
      { { 0, E::Press }, { 1, E::Few, "", acts }, { 2, E::Few }, { 3, E::Release, "start 1" } } },
    Sequence{ "refinementFollowsMotion",
      { { 0, E::RefineNext }, { 1, E::Moving, "start 500" }, { 100, E::RefineNext },
        { 101, E::Few }, { 500, E::Own, "draw" }, { 500, E::RefineNext, "start 1" } } },
    Sequence{ "withoutATimerNothingRefines",
      { { 0, E::Press }, { 1, E::Moving, "", acts }, { 2, E::Release, "start 499" }, { 2, E::Fail },
        { 3, E::RefineNext, "start 1" }, { 3, E::Fail }, { 4, E::Resting } } },
    Sequence{ "aSceneThatChangesInEachFrameEnds",
      { { 0, E::Few, "start 1" }, { 1, E::Own, "draw" }, { 2, E::Few, "start 1" },
        { 3, E::Own, "draw" }, { 3, E::RefineNext }, { 4, E::Few }, { 5, E::Other } } },
    Sequence{ "aLostTimerIsReplaced",
      { { 0, E::Moving, "start 500" }, { 1400, E::Moving }, { 1600, E::Moving, "start 500" } } }),
  [](const auto& of) { return of.param.name; });

} // namespace
} // namespace gnomon::test
