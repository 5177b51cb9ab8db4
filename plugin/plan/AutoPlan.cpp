#include "plugin/plan/AutoPlan.h"

#include "lights/LightViews.h"
#include "plugin/plan/AutoSteps.h"
#include "plugin/plan/PicturePlan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gnomon
{
namespace
{

/// Maps are used only if rays take more than this factor longer.
constexpr double nearlyAsFast = 1.3;

/// Least and most moving frames until rays and maps may switch.
constexpr int leastPatience = 30;
constexpr int mostPatience = 960;

/// Frames until a map that is still baked is tried again, if rays do not keep the time budget.
constexpr int patienceIfLate = 8;

/// Frames between probes of a map, if it is reused and if each frame bakes it.
constexpr int framesPerProbe = 16;
constexpr int framesPerProbeOfMoved = 4;

/// The largest side to which an error limit enlarges a map.
constexpr int mostTexels = 4096;

std::string percent(double share)
{
  const std::string text = std::to_string(100.0 * share);
  return text.substr(0, text.find('.') + 3) + " %";
}

/// Thrown where the plan needs evidence that it has not got.
struct Needs
{
  EvidenceRequest request;
};

/// Makes one plan; its members are the plan's inputs, and the history that it leaves.
class Planner
{
public:
  Planner(const Scene& scene, const std::vector<LightPlan>& lights, const FrameWishes& wishes,
    const AutoHistory& history, const std::vector<Evidence>& evidence)
    : scene_(scene)
    , lights_(lights)
    , wishes_(wishes)
    , evidence_(evidence)
    , history_(history)
  {
    for (const LightPlan& light : lights)
    {
      if (light.asked)
      {
        this->asked_.push_back({ light, { light.light.sceneIndex } });
      }
    }
  }

  AutoPlan plan();

private:
  /// A light that leaves its technique to the pass, with this frame's.
  struct Asked
  {
    const LightPlan& light;
    AutoChoice choice;
  };

  FrameCounters takeChanges();
  void rest();
  std::string move(const FrameCounters& counters);
  std::string whyNoMaps() const;
  std::string whyRaysAreFast(double byMaps, double byRays) const;
  double expectedByRays(double modelled) const;
  std::string tryMap(const LightPlan& light, AutoChoice& choice);
  void takeSamples(const LightPlan& light, AutoChoice& choice);
  const Evidence& evidenceFor(const EvidenceRequest& request);
  AutoHistory::Light& historyOf(const LightPlan& light)
  {
    return this->history_.lights[light.light.sceneIndex];
  }

  const Scene& scene_;
  const std::vector<LightPlan>& lights_;
  const FrameWishes& wishes_;
  const std::vector<Evidence>& evidence_;
  std::size_t evidenceUsed_ = 0;
  AutoHistory history_;
  std::vector<Asked> asked_;
};

AutoPlan Planner::plan()
{
  AutoPlan plan;
  const auto isSoftOne = [](const Asked& asked) { return asked.light.isSoft(); };
  if (!this->asked_.empty())
  {
    const FrameCounters counters = this->takeChanges();
    if (!this->scene_.picture.moves)
    {
      for (Asked& asked : this->asked_)
      {
        // An area light's first frame at rest shows as many samples as the motion.
        asked.choice.firstSamples =
          this->scene_.picture.mayRefine ? this->historyOf(asked.light).samples : 0;
      }
      this->rest();
      plan.choice = "the picture rests: exact";
    }
    else if (std::any_of(this->asked_.begin(), this->asked_.end(), isSoftOne))
    {
      for (Asked& asked : this->asked_)
      {
        if (isSoftOne(asked))
        {
          this->takeSamples(asked.light, asked.choice);
        }
      }
      plan.choice = "the picture moves: rays, as area lights are traced in any case";
    }
    else
    {
      plan.choice = this->move(counters);
    }
  }
  for (const Asked& asked : this->asked_)
  {
    plan.choices.push_back(asked.choice);
  }
  plan.history = std::move(this->history_);
  return plan;
}

/// Return the present counts, and note what changed since the last frame.
FrameCounters Planner::takeChanges()
{
  const SceneProps& props = this->scene_.props;
  const ScenePicture& picture = this->scene_.picture;
  AutoHistory& history = this->history_;
  FrameCounters counters;
  // The first frame's casters have not moved.
  counters.castersMoved = history.casters.first != 0 && props.casters != history.casters;
  counters.viewMoved = counters.castersMoved || picture.view != history.view;
  counters.triangles = props.triangles;
  counters.drawn = props.drawn;
  counters.pixels = picture.pixels;

  std::map<int, AutoHistory::Light> known;
  for (const LightPlan& of : this->lights_)
  {
    const ShadowLight& light = of.light;
    AutoHistory::Light choice = history.lights[light.sceneIndex];
    const AutoHistory::Request request{ light.area.has_value(), light.mapSizeTexels,
      light.lightSamples, light.area ? this->wishes_.maximumSoftError : this->wishes_.maximumError,
      light.area ? light.area->radius() : 0.0 };
    const bool isAlike = request.isLike(choice.request);
    if (!isAlike)
    {
      choice = AutoHistory::Light{};
      choice.request = request;
    }
    const bool moved = counters.castersMoved || (isAlike && choice.identity != of.identity);
    choice.identity = of.identity;
    choice.tracedShare = moved ? 1.0 : choice.tracedShare;
    choice.sinceProbed += moved ? framesPerProbe / framesPerProbeOfMoved : 1;
    counters.lights += of.asked && !of.isSoft() ? 1 : 0;
    if (of.asked && !light.area)
    {
      const auto side = static_cast<std::size_t>(light.mapSizeTexels) << choice.step;
      const std::size_t views = static_cast<std::size_t>(std::max(mostViews(light), 1));
      counters.texels = std::max(counters.texels, side * side * views);
      counters.tracedLights += choice.tracedShare;
      counters.movedLights += moved ? 1 : 0;
      counters.newMaps += !moved && !choice.isProbed ? 1 : 0;
    }
    known[light.sceneIndex] = choice;
  }
  history.lights = std::move(known); // drops lights that are gone
  history.view = picture.view;
  history.casters = props.casters;
  return counters;
}

/// Reset the hysteresis. The next motion proves its choices again.
void Planner::rest()
{
  this->history_.patience = 0;
  this->history_.byRays = 0;
  this->history_.byMaps = 0;
  for (auto& [sceneIndex, light] : this->history_.lights)
  {
    light.step = light.request.isSoft ? 0 : light.step;
    light.isProbed = false;
    light.probe = {};
  }
}

/// Choose between maps and rays for lights with hard shadows.
/// @return the report's sentence
std::string Planner::move(const FrameCounters& counters)
{
  AutoHistory& history = this->history_;
  const double byMaps = costByMaps(counters, this->scene_.picture.factors);
  const double byRays = costByRays(counters, this->scene_.picture.factors);
  const double budget = this->wishes_.timeBudget;
  std::string whyRays = this->whyNoMaps();
  const bool mayHaveMaps = whyRays.empty();
  const bool triesSoon =
    counters.movedLights == 0 && budget > 0.0 && this->expectedByRays(byRays) > budget;
  const int patience = triesSoon ? std::min(history.patience, patienceIfLate) : history.patience;
  const bool waits = history.byRays > 0 && history.byRays < patience;
  if (mayHaveMaps && waits && !history.whyRays.empty())
  {
    whyRays = history.whyRays;
  }
  else if (mayHaveMaps)
  {
    whyRays = this->whyRaysAreFast(byMaps, byRays);
    if (!whyRays.empty() && budget == 0.0)
    {
      history.patience = std::max(history.patience, leastPatience);
      history.byRays = 0;
    }
  }
  for (auto asked = this->asked_.begin(); asked != this->asked_.end() && whyRays.empty(); ++asked)
  {
    whyRays = this->tryMap(asked->light, asked->choice);
    if (!whyRays.empty())
    {
      history.patience = std::clamp(2 * history.patience, leastPatience, mostPatience);
      history.byRays = 0;
    }
  }
  const bool takesMaps = whyRays.empty();
  history.whyRays = mayHaveMaps ? whyRays : "";
  history.byMaps = takesMaps ? history.byMaps + 1 : 0;
  history.byRays = takesMaps ? 0 : history.byRays + 1;
  history.patience = history.byMaps >= leastPatience ? 0 : history.patience;
  std::string text = "the picture moves: ";
  if (takesMaps)
  {
    text += "maps, which keep the error of " + percent(this->wishes_.maximumError);
  }
  else
  {
    for (Asked& asked : this->asked_)
    {
      asked.choice.way = AutoChoice::Way::Resting;
      this->historyOf(asked.light).isProbed = false; // the next map is proved before it is shown
      this->historyOf(asked.light).probe = {};
    }
    text += "rays, as " + whyRays;
  }
  if (budget > 0.0)
  {
    const double taken = history.times.restByMaps;
    const double expectedByMaps = taken > 0.0 ? taken : byMaps;
    const double expected = takesMaps ? expectedByMaps : this->expectedByRays(byRays);
    text += expected > budget ? "; the time budget is not kept" : "";
  }
  return text;
}

/// Return why lights with hard shadows cannot use maps in this frame, as a clause; empty if they
/// may.
std::string Planner::whyNoMaps() const
{
  const std::string why = whyNoInlineMaps(this->lights_, this->wishes_, this->scene_);
  if (!why.empty())
  {
    return why;
  }
  if (WrongProbes{ mostLooks * probesOfALook, 0 }.mostShare() > this->wishes_.maximumError)
  {
    return "probes cannot show an error as small as the limit";
  }
  return this->scene_.props.unseenReceiver
    ? "a surface shows shadows but casts none, or shader code moves it, so probes miss it"
    : "";
}

/// Return why rays are used though maps may be, as a clause; empty if they are not.
/// @param byMaps, byRays modelled milliseconds
std::string Planner::whyRaysAreFast(double byMaps, double byRays) const
{
  const double budget = this->wishes_.timeBudget;
  if (budget == 0.0)
  {
    return byRays <= nearlyAsFast * byMaps ? "they take nearly as little time as maps" : "";
  }
  // After maps, rays return only with time to spare, and after some frames.
  constexpr double spared = 0.85;
  const int mapFrames = this->history_.byMaps;
  const bool stay = mapFrames > 0 && mapFrames < leastPatience;
  const double least = mapFrames > 0 ? spared * budget : budget;
  const bool fits = this->expectedByRays(byRays) <= least || byRays <= byMaps;
  return !stay && fits ? "they keep the time budget" : "";
}

/// Return the milliseconds of a frame by rays, as earlier ones took.
/// @param modelled if there were none
double Planner::expectedByRays(double modelled) const
{
  const MotionTimes& times = this->history_.times;
  return times.restByRays == 0.0
    ? modelled
    : std::accumulate(this->asked_.begin(), this->asked_.end(), times.restByRays,
        [&](double sum, const Asked& asked)
        {
          const auto image = times.sample.find(asked.choice.sceneIndex);
          return image == times.sample.end() ? sum : sum + image->second;
        });
}

/// Shade a light by a map, the coarsest from the present step on that keeps the error. Before a
/// motion shows a map, it may be a coarser one, too.
/// @return why there is none, as a clause; empty on success
std::string Planner::tryMap(const LightPlan& light, AutoChoice& choice)
{
  const double limit = this->wishes_.maximumError;
  AutoHistory::Light& known = this->historyOf(light);
  const int asked = light.asked->mapSizeTexels;
  if (asked > light.mostMapTexels)
  {
    return "the memory budget has no room for maps";
  }
  int mostSteps = 0;
  while (asked << (mostSteps + 1) <= std::min(mostTexels, light.mostMapTexels))
  {
    ++mostSteps;
  }
  const bool isShown = known.isProbed;
  bool hasShrunk = false;
  for (;;)
  {
    const int side = asked << known.step;
    const Composition map = planAsMap(*light.asked, side, this->scene_);
    if (!map.estimator)
    {
      return map.refusal;
    }
    choice.way = AutoChoice::Way::Map;
    choice.mapSizeTexels = side;
    if (known.isProbed && known.sinceProbed < framesPerProbe)
    {
      return {};
    }
    const Evidence& evidence =
      this->evidenceFor({ light.light.sceneIndex, side, 0, limit, known.probe, known.isProbed });
    if (!evidence.failure.empty())
    {
      return evidence.failure;
    }
    if (!evidence.isClear)
    {
      known.probe = evidence.probe;
      return {};
    }
    known.probe = {};
    const WrongProbes wrong = evidence.probe.found;
    known.sinceProbed = 0;
    // If no point of all looks faces the light, hardly one pixel in 4,000 does.
    if (wrong.asked == 0 || wrong.mostShare() <= limit)
    {
      const int spare = isShown || hasShrunk ? 0 : spareSteps(wrong, mostLooks, known.step, limit);
      known.isProbed = spare == 0;
      if (known.isProbed)
      {
        return {};
      }
      known.step -= spare;
      hasShrunk = true;
      continue;
    }
    known.isProbed = false;
    if (wrong.wrong == 0)
    {
      return "only " + std::to_string(wrong.asked) +
        " of the probed pixels face the light, too few to show the error";
    }
    if (known.step == mostSteps)
    {
      return "of " + std::to_string(wrong.asked) + " pixels " + std::to_string(wrong.wrong) +
        " are wrong with a map of " + std::to_string(side) + " texels";
    }
    const double factor = std::max(wrong.share() / limit, 2.0); // as in spareSteps()
    known.step = std::min(known.step + static_cast<int>(std::log2(factor)), mostSteps);
  }
}

/// Choose the first step of an area light, from the present one on, that keeps the error: hard
/// shadows of its centre, or its fewest samples.
void Planner::takeSamples(const LightPlan& light, AutoChoice& choice)
{
  const double limit = this->wishes_.maximumSoftError;
  AutoHistory::Light& known = this->historyOf(light);
  known.samples = 0;
  if (!light.light.area || limit == 0.0)
  {
    return;
  }
  const int all = samplesInTime(this->wishes_, this->history_.times, light.light.sceneIndex,
    this->lights_.size(), light.light.lightSamples);
  const bool mayBeHard = !light.light.texture && planAsCentre(*light.asked, this->scene_).estimator;
  if (all < fewSamples.front())
  {
    // The time comes before the error, so nothing is proved.
    known.samples = fewSamples.front();
    choice.way = mayBeHard ? AutoChoice::Way::Centre : AutoChoice::Way::Resting;
    choice.lightSamples = mayBeHard ? 0 : known.samples;
    return;
  }
  for (;; ++known.step)
  {
    const bool isHard = known.step == 0;
    known.samples = std::min(samplesOf(std::max(known.step, 1)), all);
    if (isHard && !mayBeHard)
    {
      continue;
    }
    choice.way = isHard ? AutoChoice::Way::Centre : AutoChoice::Way::Resting;
    choice.lightSamples = isHard ? 0 : known.samples;
    const bool hasAll = !isHard && known.samples == all;
    if (hasAll || (known.isProbed && known.sinceProbed < framesPerProbe))
    {
      return;
    }
    known.sinceProbed = 0;
    known.isProbed =
      this->evidenceFor({ light.light.sceneIndex, 0, choice.lightSamples, limit, {}, false })
        .keepsError;
    if (known.isProbed)
    {
      return;
    }
  }
}

/// Return the answer to a request: a plan that is made again asks the same, in the same order.
/// @throws Needs if there is none yet
const Evidence& Planner::evidenceFor(const EvidenceRequest& request)
{
  if (this->evidenceUsed_ == this->evidence_.size())
  {
    throw Needs{ request };
  }
  return this->evidence_[this->evidenceUsed_++];
}

} // namespace

AutoPlan planAuto(const Scene& scene, const std::vector<LightPlan>& lights,
  const FrameWishes& wishes, const AutoHistory& history, const std::vector<Evidence>& evidence)
{
  try
  {
    return Planner(scene, lights, wishes, history, evidence).plan();
  }
  catch (const Needs& needs)
  {
    AutoPlan plan;
    plan.needs = needs.request;
    return plan;
  }
}

} // namespace gnomon
