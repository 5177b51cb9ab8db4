#include "plugin/frame/TechniqueChoice.h"

#include "plugin/scene/ShownView.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/tracing/GpuTracer.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// Rays are taken at once where maps save less than that.
constexpr double nearlyAsFast = 1.3;

/// How many frames that move come at least between rays and maps, and at most.
constexpr int leastPatience = 30;
constexpr int mostPatience = 960;

/// How many frames a map is shown until it is probed again: as it is, and while it is drawn anew.
constexpr int framesPerProbe = 16;
constexpr int framesPerProbeOfMoved = 4;

/// The largest map that is taken for an error's sake.
constexpr int mostTexels = 4096;

/// The fewest samples of an area light.
constexpr int fewestSamples = 4;

std::string percent(double share)
{
  const std::string text = std::to_string(100.0 * share);
  return text.substr(0, text.find('.') + 3) + " %";
}

double medianOf(std::deque<double> numbers)
{
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

CostFactors factorsOf(const FrameWishes& wishes)
{
  const GLubyte* const name = glGetString(GL_RENDERER);
  return wishes.factors
    ? *wishes.factors
    : defaultFactors(isSoftwareRenderer(name ? reinterpret_cast<const char*>(name) : ""));
}

} // namespace

//------------------------------------------------------------------------------
TechniqueChoice::TechniqueChoice(
  Frame& frame, const Occluders& occluders, VisibilityStage& visibility, ShaderLibrary& shaders)
  : frame_(frame)
  , occluders_(occluders)
  , visibility_(visibility)
  , shaders_(shaders)
{
}

//------------------------------------------------------------------------------
void TechniqueChoice::choose(const std::function<void(CastingLight&)>& bake)
{
  this->looked_ = false;
  this->modelled_ = 0.0;
  std::vector<CastingLight*> hard;
  std::vector<CastingLight*> soft;
  for (CastingLight& casting : this->frame_.lights)
  {
    if (casting.asked)
    {
      (casting.light.area || casting.light.texture ? soft : hard).push_back(&casting);
    }
  }
  if (hard.empty() && soft.empty())
  {
    return;
  }
  const FrameCounters counters = this->takeChanges(hard);
  std::string& reason = this->frame_.report.choice;
  if (!this->frame_.wishes.moves)
  {
    this->rest();
    reason = "the picture rests: exact";
    return;
  }
  for (CastingLight* const casting : soft)
  {
    this->takeSamples(*casting);
  }
  reason = soft.empty() ? this->whyRays(counters) : "area lights are traced in any case";
  for (std::size_t i = 0; i < hard.size() && reason.empty(); ++i)
  {
    reason = this->whyNoMap(*hard[i], bake);
    if (!reason.empty())
    {
      this->patience_ = std::clamp(2 * this->patience_, leastPatience, mostPatience);
      this->byRays_ = 0;
    }
  }
  const bool takesMaps = reason.empty() && !hard.empty();
  this->byMaps_ = takesMaps ? this->byMaps_ + 1 : 0;
  this->byRays_ = takesMaps ? 0 : this->byRays_ + 1;
  this->patience_ = this->byMaps_ >= leastPatience ? 0 : this->patience_;
  const CostFactors factors = factorsOf(this->frame_.wishes);
  if (takesMaps)
  {
    reason = "the picture moves: maps, which keep the error of " +
      percent(this->frame_.wishes.maximumError);
    this->modelled_ = costByMaps(counters, factors);
    return;
  }
  for (CastingLight* const casting : hard)
  {
    this->frame_.lights.takeResting(*casting, this->frame_.report);
  }
  reason = "the picture moves, and rays are taken: " + reason;
  this->modelled_ = costByRays(counters, factors);
}

//------------------------------------------------------------------------------
/// What changed since the frame before, and what there is.
FrameCounters TechniqueChoice::takeChanges(const std::vector<CastingLight*>& lights)
{
  std::size_t view = 0;
  hashView(view, this->frame_.camera, this->frame_.size);
  const std::pair casters(this->occluders_.topologyVersion, this->occluders_.positionsVersion);
  FrameCounters counters;
  // What is there for the first time need not move again.
  counters.castersMoved = this->casters_.first != 0 && casters != this->casters_;
  counters.viewMoved = counters.castersMoved || view != this->view_;
  counters.triangles = this->frame_.report.triangles;
  counters.pixels =
    static_cast<std::size_t>(this->frame_.size.x) * static_cast<std::size_t>(this->frame_.size.y);
  counters.lights = lights.size();
  std::map<int, LightChoice> known;
  for (const CastingLight* const casting : lights)
  {
    const ShadowLight& light = casting->light;
    const auto side = static_cast<std::size_t>(light.mapSizeTexels);
    counters.texels = std::max(
      counters.texels, side * side * static_cast<std::size_t>(std::max(mostViews(light), 1)));
    const bool isKnown = this->lights_.count(light.sceneIndex) != 0;
    LightChoice& choice = known[light.sceneIndex] = this->lights_[light.sceneIndex];
    const Place place(light.positionWorld, light.directionWorld, light.coneAngleDegrees);
    const bool moved = counters.castersMoved || (isKnown && choice.place != place);
    counters.movedLights += moved ? 1 : 0;
    choice.place = place;
    choice.sinceProbed += moved ? framesPerProbe / framesPerProbeOfMoved : 1;
  }
  for (const CastingLight& casting : this->frame_.lights)
  {
    known.try_emplace(casting.light.sceneIndex, this->lights_[casting.light.sceneIndex]);
  }
  this->lights_ = std::move(known); // those of lights that are gone go, too
  this->view_ = view;
  this->casters_ = casters;
  return counters;
}

//------------------------------------------------------------------------------
/// The next motion begins anew.
void TechniqueChoice::rest()
{
  this->patience_ = 0;
  this->byRays_ = 0;
  this->byMaps_ = 0;
  for (auto& [sceneIndex, choice] : this->lights_)
  {
    choice.isProbed = false;
  }
}

//------------------------------------------------------------------------------
/// Why lights with hard shadows take rays whatever their maps say, as a clause; empty if they need
/// not.
std::string TechniqueChoice::whyRays(const FrameCounters& counters)
{
  const FrameWishes& wishes = this->frame_.wishes;
  if (wishes.route == RouteWish::Image || wishes.route == RouteWish::Deferred)
  {
    return "the route is asked for";
  }
  if (wishes.maximumError == 0.0)
  {
    return "no error is allowed";
  }
  if (wishes.keepVisibility)
  {
    return "the visibility is kept";
  }
  if (this->frame_.lights.size() > mostInlineLights)
  {
    return "shaders would ask the maps of " + std::to_string(this->frame_.lights.size()) +
      " lights, and " + std::to_string(mostInlineLights) + " are the most";
  }
  const auto isOther = [](const CastingLight& casting)
  { return !casting.asked && !casting.own.info().isPointwise(); };
  if (std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(), isOther))
  {
    return "another light's technique works on the whole screen";
  }
  if (this->occluders_.castsSolids())
  {
    return "maps do not know casters that are spheres or cylinders";
  }
  if (this->byRays_ > 0 && this->byRays_ < this->patience_)
  {
    return "they were a few frames ago";
  }
  const double byMaps = costByMaps(counters, factorsOf(wishes));
  const double byRays = costByRays(counters, factorsOf(wishes));
  if (wishes.timeBudget > 0.0)
  {
    return this->whyRaysInTime(byMaps, byRays);
  }
  if (byRays <= nearlyAsFast * byMaps)
  {
    this->patience_ = leastPatience;
    this->byRays_ = 0;
    return "they take nearly as little time as maps";
  }
  return {};
}

//------------------------------------------------------------------------------
/// The same where there is a time budget.
/// @param byMaps, byRays modelled milliseconds
std::string TechniqueChoice::whyRaysInTime(double byMaps, double byRays) const
{
  const std::deque<double>& slownesses =
    this->slownessByRays_.empty() ? this->slownessByMaps_ : this->slownessByRays_;
  const double slowness = slownesses.empty() ? 1.0 : medianOf(slownesses);
  const double budget = this->frame_.wishes.timeBudget;
  // Once maps have been taken, rays come back where there is time to spare, and not at once.
  constexpr double spared = 0.85;
  const bool stay = this->byMaps_ > 0 && this->byMaps_ < leastPatience;
  const double least = this->byMaps_ > 0 ? spared * budget : budget;
  return !stay && (slowness * byRays <= least || byRays <= byMaps) ? "they keep the time budget"
                                                                   : "";
}

//------------------------------------------------------------------------------
/// Has a light take a map, the coarsest that keeps the error.
/// @return why there is none, as a clause; empty where it has one
std::string TechniqueChoice::whyNoMap(
  CastingLight& casting, const std::function<void(CastingLight&)>& bake)
{
  FrameReport& report = this->frame_.report;
  LightChoice& choice = this->lights_[casting.light.sceneIndex];
  const int asked = casting.asked->mapSizeTexels;
  int mostSteps = 0;
  while (asked << (mostSteps + 1) <= mostTexels)
  {
    ++mostSteps;
  }
  choice.step = std::min(choice.step, mostSteps);
  for (;;)
  {
    const std::string refusal = this->frame_.lights.takeMap(casting, asked << choice.step, report);
    if (!refusal.empty())
    {
      return refusal;
    }
    if (choice.isProbed && choice.sinceProbed < framesPerProbe)
    {
      return {};
    }
    try
    {
      bake(casting);
    }
    catch (const TextureMemoryError& error)
    {
      return error.what();
    }
    const double limit = this->frame_.wishes.maximumError;
    const std::optional<WrongProbes> probed = this->probe(casting, limit);
    if (!probed)
    {
      return "the tracer does not say what pixels show, so that no map can be checked";
    }
    const WrongProbes& wrong = *probed;
    choice.isProbed = wrong.mostShare() <= limit;
    choice.sinceProbed = 0;
    if (choice.isProbed || wrong.asked == 0) // what is seen faces no light
    {
      return {};
    }
    // Wrong pixels are along edges, where they are as many as texels are wide.
    const double factor = std::max(wrong.share() / limit, 2.0);
    const int step = choice.step + static_cast<int>(std::log2(factor));
    if (step > mostSteps)
    {
      return "of " + std::to_string(wrong.asked) + " pixels " + std::to_string(wrong.wrong) +
        " are wrong with a map of " + std::to_string(casting.light.mapSizeTexels) + " texels";
    }
    choice.step = step;
  }
}

//------------------------------------------------------------------------------
/// How wrong a light's map is, at as many pixels as it takes to know on which side of a limit.
/// @return nothing where the tracer does not see the pixels
std::optional<WrongProbes> TechniqueChoice::probe(const CastingLight& casting, double limit)
{
  constexpr int mostLooks = 4;
  WrongProbes all;
  for (int looks = 0; looks < mostLooks; ++looks)
  {
    this->looked_ = this->looked_ && looks == 0;
    if (!this->look())
    {
      return {};
    }
    const WrongProbes wrong =
      this->probes_.wrongOf(*casting.own.as<PointwiseTechnique>(), casting.light,
        this->frame_.space, this->occluders_, this->visibility_.shadowTracer(), this->shaders_);
    all.asked += wrong.asked;
    all.wrong += wrong.wrong;
    if (wrong.asked == 0 || all.mostShare() <= limit || all.share() > limit)
    {
      break;
    }
  }
  this->frame_.report.probes += static_cast<std::int64_t>(all.asked);
  return all;
}

//------------------------------------------------------------------------------
/// Has an area light take the fewest samples that keep the error.
void TechniqueChoice::takeSamples(CastingLight& casting)
{
  LightChoice& choice = this->lights_[casting.light.sceneIndex];
  const auto samplesOf = [](int step) { return fewestSamples << (2 * step); }; // square numbers
  const int all = casting.light.lightSamples;
  if (this->frame_.wishes.maximumSoftError == 0.0 || this->occluders_.castsSolids())
  {
    return;
  }
  choice.sinceProbed += choice.isProbed ? 1 : 0;
  while (samplesOf(choice.step) < all && !(choice.isProbed && choice.sinceProbed < framesPerProbe))
  {
    if (!this->look())
    {
      return;
    }
    const double error = this->probes_.rmsOf(
      samplesOf(choice.step), casting.light, this->occluders_, this->visibility_.shadowTracer());
    this->frame_.report.probes += Probes::across * Probes::across / 4;
    choice.sinceProbed = 0;
    choice.isProbed = error <= this->frame_.wishes.maximumSoftError;
    choice.step += choice.isProbed ? 0 : 1;
  }
  casting.light.lightSamples = std::min(samplesOf(choice.step), all);
}

//------------------------------------------------------------------------------
/// Finds points to probe; the same ones for all who ask in a frame, unless `looked_` says otherwise.
/// @return false where the tracer does not see them
bool TechniqueChoice::look()
{
  if (!this->looked_)
  {
    this->visibility_.updateTracer();
    const CasterHits* const hits = this->visibility_.shadowTracer().casterHits();
    if (!hits)
    {
      return false;
    }
    this->probes_.look(
      this->frame_.camera, this->frame_.size, this->occluders_, *hits, this->looks_++);
    this->looked_ = true;
  }
  return true;
}

//------------------------------------------------------------------------------
void TechniqueChoice::endFrame(double milliseconds)
{
  constexpr std::size_t frames = 30;
  if (this->modelled_ > 0.0)
  {
    std::deque<double>& slowness =
      this->byMaps_ > 0 ? this->slownessByMaps_ : this->slownessByRays_;
    slowness.push_back(milliseconds / this->modelled_);
    if (slowness.size() > frames)
    {
      slowness.pop_front();
    }
  }
}

} // namespace gnomon
