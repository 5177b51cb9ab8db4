#include "plugin/plan/MotionTimes.h"

#include <algorithm>
#include <numeric>

namespace gnomon
{
namespace
{

/// How much of a new time counts: a load shows within a few frames, one slow frame does not.
constexpr double shareOfNew = 0.4;

/// Factor per frame by which unused rays are expected to get cheaper, after `patience` frames.
constexpr double forgetting = 0.98;
constexpr int patience = 30;

///@{
/// Rough cost of drawing a frame, in times of VTK's own. Maps are looked up; rays also need
/// triangle numbers and colours in shadow.
constexpr double drawnByMaps = 1.2;
constexpr double drawnByRays = 2.0;
///@}

/// The part of the limit that is planned for, as frames' times differ.
constexpr double spared = 0.9;

void mix(double& known, double milliseconds)
{
  known = known > 0.0 ? known + shareOfNew * (milliseconds - known) : milliseconds;
}

} // namespace

void MotionTimes::add(bool byRays, double rest)
{
  mix(byRays ? this->restByRays : this->restByMaps, rest);
  this->framesByMaps = byRays ? 0 : this->framesByMaps + 1;
  if (this->framesByMaps > patience)
  {
    this->restByRays *= forgetting;
    for (auto& [sceneIndex, milliseconds] : this->sample)
    {
      milliseconds *= forgetting;
    }
  }
}

void MotionTimes::addImage(int sceneIndex, double samples, double milliseconds)
{
  mix(this->sample[sceneIndex], milliseconds / std::max(samples, 1.0));
}

void MotionTimes::addSky(double milliseconds)
{
  if (milliseconds > 0.0)
  {
    mix(this->sky, milliseconds);
    return;
  }
  this->sky *= forgetting;
}

double limitOf(const FrameWishes& wishes, const MotionTimes& times)
{
  const double asked = std::max(wishes.windowTime, wishes.isShared ? wishes.timeBudget : 0.0);
  if (asked == 0.0)
  {
    return 0.0;
  }
  const double drawing =
    times.restByMaps > 0.0 ? times.restByMaps / drawnByMaps : times.restByRays / drawnByRays;
  return std::max(asked, 1.3 * drawing);
}

bool skyIsInTime(const FrameWishes& wishes, const MotionTimes& times)
{
  const double limit = limitOf(wishes, times);
  const double images = std::accumulate(times.sample.begin(), times.sample.end(), 0.0,
    [](double sum, const auto& sample) { return sum + sample.second; });
  const double rest = std::max(times.restByRays, times.restByMaps);
  return limit == 0.0 || times.sky == 0.0 || rest + images + times.sky <= spared * limit;
}

int samplesInTime(
  const FrameWishes& wishes, const MotionTimes& times, int sceneIndex, std::size_t lights, int most)
{
  const double limit = limitOf(wishes, times);
  const auto sample = times.sample.find(sceneIndex);
  if (limit == 0.0 || sample == times.sample.end() || sample->second == 0.0)
  {
    return most;
  }
  const double share = std::max(spared * limit - times.restByRays - times.reserved, 0.0) /
    static_cast<double>(std::max<std::size_t>(lights, 1));
  return static_cast<int>(std::min<double>(most, share / sample->second));
}

} // namespace gnomon
