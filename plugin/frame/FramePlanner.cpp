#include "plugin/frame/FramePlanner.h"

#include "shadowtech/base/Clock.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <utility>

namespace gnomon
{

FramePlanner::FramePlanner(
  Frame& frame, const Occluders& occluders, SnapshotTracer& tracer, ShaderLibrary& shaders)
  : frame_(frame)
  , occluders_(occluders)
  , tracer_(tracer)
  , shaders_(shaders)
{
}

void FramePlanner::plan(const Bake& bake, const ReadDeferredFacts& readDeferredFacts)
{
  const double start = steadyMilliseconds();
  this->looked_ = false;
  Scene& scene = this->frame_.scene;
  if (scene.picture.moves)
  {
    this->takeTimesOfFirst();
  }
  FramePlan& plan = this->frame_.plan;
  const FrameWishes& wishes = this->frame_.wishes;
  plan = planAtRest(scene, wishes, this->history_);
  this->frame_.lights.begin(plan.lights, this->frame_.view->techniques);
  std::vector<Evidence> evidence;
  plan = planTechniques(std::move(plan), scene, wishes, evidence);
  while (plan.needs) // each need is another map or number of samples, of which there are few
  {
    const auto light = std::find_if(plan.lights.begin(), plan.lights.end(),
      [&](const LightPlan& of) { return of.light.sceneIndex == plan.needs->sceneIndex; });
    evidence.push_back(this->gather(*plan.needs, *light, bake));
    plan = planTechniques(std::move(plan), scene, wishes, evidence);
  }
  if (plan.needsDeferredFacts)
  {
    scene.deferred = readDeferredFacts();
  }
  plan = planDrawing(std::move(plan), scene, wishes);
  this->history_ = plan.history;
  this->frame_.lights.take(plan.lights);
  this->milliseconds_ = steadyMilliseconds() - start;
}

/// Have all processes plan by the first one's times: it may be the only one with an interactor.
void FramePlanner::takeTimesOfFirst()
{
  FrameWishes& wishes = this->frame_.wishes;
  MotionTimes& times = this->history_.times;
  const std::vector<ShadowLight>& lights = this->frame_.scene.lights.set.lights;
  std::vector<double> numbers{ wishes.windowTime, wishes.timeBudget, times.restByRays };
  for (const ShadowLight& light : lights)
  {
    numbers.push_back(times.sample[light.sceneIndex]);
  }
  numbers = this->frame_.ranks->ofFirst(numbers);
  auto number = numbers.begin();
  wishes.windowTime = *number++;
  wishes.timeBudget = *number++;
  times.restByRays = *number++;
  for (const ShadowLight& light : lights)
  {
    times.sample[light.sceneIndex] = *number++;
  }
}

Evidence FramePlanner::gather(
  const EvidenceRequest& request, const LightPlan& resting, const Bake& bake)
{
  Evidence evidence;
  const Scene& scene = this->frame_.scene;
  if (request.mapSizeTexels == 0)
  {
    ShadowLight other =
      request.lightSamples > 0 ? resting.light : planAsCentre(*resting.asked, scene).light;
    other.lightSamples = request.lightSamples > 0 ? request.lightSamples : other.lightSamples;
    evidence.keepsError = this->keepsError(other, resting.light, request.errorLimit);
    return evidence;
  }
  const Composition map = planAsMap(*resting.asked, request.mapSizeTexels, scene);
  LightTechnique& technique = this->frame_.lights.techniqueOf(map.light, *map.estimator);
  try
  {
    bake(map.light, technique);
    this->probe(*technique.as<PointwiseTechnique>(), map.light, request, evidence);
  }
  catch (const TextureMemoryError& error)
  {
    evidence.failure = error.what();
  }
  return evidence;
}

/// Probe a light's map until it is clear on which side of a limit its error is. A map that is shown
/// meanwhile has one look in this frame. If the light shines on a small part of the picture, look
/// there, too.
void FramePlanner::probe(const PointwiseTechnique& technique, const ShadowLight& map,
  const EvidenceRequest& request, Evidence& evidence)
{
  evidence.probe = request.before;
  WrongProbes& found = evidence.probe.found;
  const std::size_t before = found.asked;
  bool isAimed = false;
  bool goesOn = false;
  do
  {
    this->look();
    const WrongProbes wrong = this->probes_.wrongOf(
      technique, map, this->frame_.space, this->occluders_, this->tracer_.get(), this->shaders_);
    found.asked += wrong.asked;
    found.wrong += wrong.wrong;
    evidence.isClear = found.mostShare() <= request.errorLimit ||
      found.leastShare() > request.errorLimit || ++evidence.probe.looks >= mostLooks;
    const bool aims = !isAimed && wrong.asked > 0 && wrong.asked < Probes::count / 4;
    goesOn = !evidence.isClear && (aims || !request.isShown);
    if (goesOn && aims)
    {
      this->probes_.aimAtFacing();
      isAimed = true;
    }
    this->looked_ = !goesOn;
  } while (goesOn);
  if (isAimed)
  {
    this->probes_.aimEverywhere();
    this->looked_ = false;
  }
  this->frame_.counts.probes += static_cast<std::int64_t>(found.asked - before);
}

/// Probe an area light's visibility, traced from another light, until it is clear on which side of
/// a limit its error is.
/// @return true if it is clear that it keeps the limit
bool FramePlanner::keepsError(const ShadowLight& other, const ShadowLight& light, double limit)
{
  SquaredErrors found;
  bool isClear = false;
  for (std::size_t looks = 0; looks < mostSoftLooks && !isClear; ++looks)
  {
    this->looked_ = this->looked_ && looks == 0;
    this->look();
    found.add(this->probes_.errorsOf(other, light, this->occluders_, this->tracer_.get()));
    isClear = found.mostRms() <= limit || found.leastRms() > limit;
  }
  this->frame_.counts.probes += static_cast<std::int64_t>(found.points);
  return found.mostRms() <= limit;
}

/// Find pixels to probe: the same ones for all probes of a frame, unless `looked_` is false.
void FramePlanner::look()
{
  if (!this->looked_)
  {
    this->tracer_.update();
    this->probes_.look(this->frame_.camera, this->frame_.size, this->occluders_,
      this->tracer_.get(), this->looks_++);
    this->looked_ = true;
  }
}

void FramePlanner::remember(double milliseconds, bool isUsual)
{
  MotionTimes& times = this->history_.times;
  double rest = milliseconds - this->milliseconds_ - this->frame_.counts.skyMilliseconds;
  bool byRays = false;
  for (const CastingLight& casting : this->frame_.lights)
  {
    const ShadowLight& light = casting.light();
    const auto known = this->history_.lights.find(light.sceneIndex);
    if (casting.tracedShare && known != this->history_.lights.end())
    {
      known->second.tracedShare = *casting.tracedShare;
    }
    rest -= casting.milliseconds;
    byRays = byRays || casting.isOnCpu();
    if (casting.isOnCpu() && casting.isStale)
    {
      const double samples = light.area ? casting.counts.progress * light.lightSamples : 1.0;
      times.addImage(light.sceneIndex, samples, casting.milliseconds);
    }
  }
  // Frames without a limit do not wait for OpenGL, so their times are too short.
  const FrameWishes& wishes = this->frame_.wishes;
  const bool isLimited = wishes.timeBudget > 0.0 || wishes.windowTime > 0.0;
  if (isUsual && isLimited && this->frame_.plan.moves)
  {
    times.add(byRays, rest);
    times.addSky(this->frame_.counts.skyMilliseconds);
  }
}

} // namespace gnomon
