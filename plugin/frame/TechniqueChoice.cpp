#include "plugin/frame/TechniqueChoice.h"

#include "plugin/scene/ShownView.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// Frames between probes of a map, if it is reused and if each frame bakes it.
constexpr int framesPerProbe = 16;
constexpr int framesPerProbeOfMoved = 4;

/// The most sets of pixels that are probed to decide whether the error is kept, by maps and under
/// area lights: 32 sets of these take as long as one or two frames.
constexpr std::size_t mostLooks = 8;
constexpr std::size_t mostSoftLooks = 32;

/// The largest side to which an error limit enlarges a map.
constexpr int mostTexels = 4096;

/// Samples of area lights in motion, tried in turn; then 16, 32, 64... Up to 16 a frame takes at
/// most 1.25 times as long as with the number before (soft-window: 24 to 52 ms).
constexpr std::array<int, 5> fewSamples = { 4, 6, 8, 10, 12 };

/// Return the samples of an area light at a step of its choice, from the second step on.
int samplesOf(int step)
{
  const auto next = static_cast<std::size_t>(step - 1);
  return next < fewSamples.size() ? fewSamples[next] : 16 << (next - fewSamples.size());
}

/// Return by how many steps a map's side is to be halved, as its probes say: wrong pixels lie along
/// edges, and their number is in proportion to the texels' width. As many probes as there may be
/// are to prove the smaller map if they go on like these, with twice as many wrong, to be safe.
int spareSteps(const WrongProbes& probes, int step, double limit)
{
  WrongProbes expected{ mostLooks * probes.asked, 2 * mostLooks * probes.wrong };
  int spare = 0;
  for (; spare < step; ++spare)
  {
    expected.wrong = std::min(2 * expected.wrong, expected.asked);
    if (expected.mostShare() > limit)
    {
      break;
    }
  }
  return spare;
}

std::string percent(double share)
{
  const std::string text = std::to_string(100.0 * share);
  return text.substr(0, text.find('.') + 3) + " %";
}

CostFactors factorsOf(const FrameWishes& wishes)
{
  const GLubyte* const name = glGetString(GL_RENDERER);
  return wishes.factors
    ? *wishes.factors
    : defaultFactors(isSoftwareRenderer(name ? reinterpret_cast<const char*>(name) : ""));
}

/// True if a surface shows shadows where no probing camera ray finds it: these meet casters, where
/// the snapshot has them.
bool isUnseenReceiver(const Surface& surface)
{
  return surface.receives && (!surface.casts || surface.isMoved) && surface.triangleCount > 0;
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
bool TechniqueChoice::Request::isLike(const Request& other) const
{
  const auto [least, most] = std::minmax(this->areaRadius, other.areaRadius);
  return this->isSoft == other.isSoft && this->mapSizeTexels == other.mapSizeTexels &&
    this->lightSamples == other.lightSamples && this->errorLimit == other.errorLimit &&
    most <= 1.1 * least;
}

//------------------------------------------------------------------------------
void TechniqueChoice::choose(const std::function<void(CastingLight&)>& bake)
{
  this->looked_ = false;
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
  std::string& choice = this->frame_.report.choice;
  if (!this->frame_.moves)
  {
    for (CastingLight* const casting : soft)
    {
      this->refine(*casting);
    }
    this->rest();
    choice = "the picture rests: exact";
    return;
  }
  for (CastingLight* const casting : soft)
  {
    this->takeSamples(*casting);
  }
  if (!soft.empty())
  {
    choice = "the picture moves: rays, as area lights are traced in any case";
    return;
  }
  this->chooseMoving(hard, counters, bake);
}

//------------------------------------------------------------------------------
/// Return the changes since the last frame and the present counts.
FrameCounters TechniqueChoice::takeChanges(const std::vector<CastingLight*>& hard)
{
  std::size_t view = 0;
  hashView(view, this->frame_.camera, this->frame_.size);
  const std::pair casters(this->occluders_.topologyVersion, this->occluders_.positionsVersion);
  FrameCounters counters;
  // The first frame's casters have not moved.
  counters.castersMoved = this->casters_.first != 0 && casters != this->casters_;
  counters.viewMoved = counters.castersMoved || view != this->view_;
  counters.triangles = this->frame_.report.triangles;
  for (const Surface& surface : this->occluders_.surfaces)
  {
    counters.drawn +=
      surface.drawnCount() * std::max<std::size_t>(surface.centredFromSource.size(), 1);
  }
  counters.pixels =
    static_cast<std::size_t>(this->frame_.size.x) * static_cast<std::size_t>(this->frame_.size.y);
  counters.lights = hard.size();

  std::map<int, LightChoice> known;
  for (const CastingLight& casting : this->frame_.lights)
  {
    const ShadowLight& light = casting.light;
    LightChoice choice = this->lights_[light.sceneIndex];
    const Request request{ light.area.has_value(), light.mapSizeTexels, light.lightSamples,
      light.area ? this->frame_.wishes.maximumSoftError : this->frame_.wishes.maximumError,
      light.area ? light.area->radius() : 0.0 };
    const bool isAlike = request.isLike(choice.request);
    if (!isAlike)
    {
      choice = LightChoice{};
      choice.request = request;
    }
    const bool moved = counters.castersMoved || (isAlike && choice.identity != casting.identity);
    choice.identity = casting.identity;
    choice.tracedShare = moved ? 1.0 : choice.tracedShare;
    choice.sinceProbed += moved ? framesPerProbe / framesPerProbeOfMoved : 1;
    if (casting.asked && !light.area)
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
  this->lights_ = std::move(known); // drops lights that are gone
  this->view_ = view;
  this->casters_ = casters;
  return counters;
}

//------------------------------------------------------------------------------
/// Reset the hysteresis. The next motion proves its choices again.
void TechniqueChoice::rest()
{
  this->patience_ = 0;
  this->byRays_ = 0;
  this->byMaps_ = 0;
  for (auto& [sceneIndex, choice] : this->lights_)
  {
    const bool isSoft = choice.request.isSoft;
    choice.step = isSoft ? 0 : choice.step;
    choice.isProbed = false;
    choice.probing = {};
  }
}

//------------------------------------------------------------------------------
/// Choose between maps and rays for lights with hard shadows.
void TechniqueChoice::chooseMoving(const std::vector<CastingLight*>& hard,
  const FrameCounters& counters, const std::function<void(CastingLight&)>& bake)
{
  const FrameWishes& wishes = this->frame_.wishes;
  const double byMaps = costByMaps(counters, factorsOf(wishes));
  const double byRays = costByRays(counters, factorsOf(wishes));
  std::string whyRays = this->whyNoMaps();
  const bool mayHaveMaps = whyRays.empty();
  const bool waits = this->byRays_ > 0 && this->byRays_ < this->patience_;
  if (mayHaveMaps && waits && !this->whyRays_.empty())
  {
    whyRays = this->whyRays_;
  }
  else if (mayHaveMaps)
  {
    whyRays = this->whyRaysAreFast(byMaps, byRays);
    if (!whyRays.empty() && wishes.timeBudget == 0.0)
    {
      this->patience_ = std::max(this->patience_, leastPatience);
      this->byRays_ = 0;
    }
  }
  for (std::size_t i = 0; i < hard.size() && whyRays.empty(); ++i)
  {
    whyRays = this->tryMap(*hard[i], bake);
    if (!whyRays.empty())
    {
      this->patience_ = std::clamp(2 * this->patience_, leastPatience, mostPatience);
      this->byRays_ = 0;
    }
  }
  this->whyRays_ = mayHaveMaps ? whyRays : "";
  const bool takesMaps = whyRays.empty();
  this->byMaps_ = takesMaps ? this->byMaps_ + 1 : 0;
  this->byRays_ = takesMaps ? 0 : this->byRays_ + 1;
  this->patience_ = this->byMaps_ >= leastPatience ? 0 : this->patience_;
  std::string& choice = this->frame_.report.choice;
  if (takesMaps)
  {
    choice = "the picture moves: maps, which keep the error of " + percent(wishes.maximumError);
  }
  else
  {
    for (CastingLight* const casting : hard)
    {
      this->frame_.lights.takeResting(*casting, this->frame_.report);
      LightChoice& light = this->lights_[casting->light.sceneIndex];
      light.isProbed = false; // the next map is proved before it is shown
      light.probing = {};
    }
    choice = "the picture moves: rays, as " + whyRays;
  }
  if (wishes.timeBudget > 0.0)
  {
    const double expected =
      takesMaps ? this->slowness_.ofMaps() * byMaps : this->slowness_.ofRays() * byRays;
    choice += expected > wishes.timeBudget ? "; the time budget is not kept" : "";
    this->slowness_.begin(takesMaps, takesMaps ? byMaps : byRays);
  }
}

//------------------------------------------------------------------------------
/// Return why lights with hard shadows cannot use maps in this frame, as a clause; empty if they
/// may.
std::string TechniqueChoice::whyNoMaps() const
{
  const FrameWishes& wishes = this->frame_.wishes;
  if (wishes.route == RouteWish::Image || wishes.route == RouteWish::Deferred)
  {
    return "the route is asked for";
  }
  if (wishes.keepVisibility)
  {
    return "the visibility is kept";
  }
  if (WrongProbes{ mostLooks * Probes::count, 0 }.mostShare() > wishes.maximumError)
  {
    return "probes cannot show an error as small as the limit";
  }
  if (this->frame_.severalViews)
  {
    return "several views are drawn and must look alike";
  }
  if (this->frame_.lights.size() > mostInlineLights)
  {
    return "shaders can read the maps of at most " + std::to_string(mostInlineLights) +
      " lights, not " + std::to_string(this->frame_.lights.size());
  }
  const auto isOther = [](const CastingLight& casting)
  { return !casting.asked && !casting.own->info().isPointwise(); };
  if (std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(), isOther))
  {
    return "another light's technique works on the whole screen";
  }
  if (std::any_of(
        this->occluders_.surfaces.begin(), this->occluders_.surfaces.end(), isUnseenReceiver))
  {
    return "a surface shows shadows but casts none, or shader code moves it, so probes miss it";
  }
  return {};
}

//------------------------------------------------------------------------------
/// Return why rays are used though maps may be, as a clause; empty if they are not.
/// @param byMaps, byRays modelled milliseconds
std::string TechniqueChoice::whyRaysAreFast(double byMaps, double byRays) const
{
  const double budget = this->frame_.wishes.timeBudget;
  if (budget == 0.0)
  {
    return byRays <= nearlyAsFast * byMaps ? "they take nearly as little time as maps" : "";
  }
  // After maps, rays return only with time to spare, and after some frames.
  constexpr double spared = 0.85;
  const bool stay = this->byMaps_ > 0 && this->byMaps_ < leastPatience;
  const double least = this->byMaps_ > 0 ? spared * budget : budget;
  const bool fits = this->slowness_.ofRays() * byRays <= least || byRays <= byMaps;
  return !stay && fits ? "they keep the time budget" : "";
}

//------------------------------------------------------------------------------
/// Shade a light by a map, the coarsest from the present step on that keeps the error. Before a
/// motion shows a map, it may be a coarser one, too.
/// @return why there is none, as a clause; empty on success
std::string TechniqueChoice::tryMap(
  CastingLight& casting, const std::function<void(CastingLight&)>& bake)
{
  const double limit = this->frame_.wishes.maximumError;
  LightChoice& choice = this->lights_[casting.light.sceneIndex];
  const int asked = casting.asked->mapSizeTexels;
  if (asked > casting.mostMapTexels)
  {
    return "the memory budget has no room for maps";
  }
  int mostSteps = 0;
  while (asked << (mostSteps + 1) <= std::min(mostTexels, casting.mostMapTexels))
  {
    ++mostSteps;
  }
  const bool isShown = choice.isProbed;
  bool hasShrunk = false;
  for (;;)
  {
    const std::string refusal =
      this->frame_.lights.takeMap(casting, asked << choice.step, this->frame_.report);
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
      if (!this->probe(casting, limit, choice))
      {
        return {};
      }
    }
    catch (const TextureMemoryError& error)
    {
      return error.what();
    }
    const WrongProbes wrong = std::exchange(choice.probing, {}).found;
    choice.sinceProbed = 0;
    // If no point of all looks faces the light, hardly one pixel in 4,000 does.
    if (wrong.asked == 0 || wrong.mostShare() <= limit)
    {
      const int spare = isShown || hasShrunk ? 0 : spareSteps(wrong, choice.step, limit);
      choice.isProbed = spare == 0;
      if (choice.isProbed)
      {
        return {};
      }
      choice.step -= spare;
      hasShrunk = true;
      continue;
    }
    choice.isProbed = false;
    if (wrong.wrong == 0)
    {
      return "only " + std::to_string(wrong.asked) +
        " of the probed pixels face the light, too few to show the error";
    }
    if (choice.step == mostSteps)
    {
      return "of " + std::to_string(wrong.asked) + " pixels " + std::to_string(wrong.wrong) +
        " are wrong with a map of " + std::to_string(casting.light.mapSizeTexels) + " texels";
    }
    const double factor = std::max(wrong.share() / limit, 2.0); // as in spareSteps()
    choice.step = std::min(choice.step + static_cast<int>(std::log2(factor)), mostSteps);
  }
}

//------------------------------------------------------------------------------
/// Probe a light's map until it is clear on which side of a limit its error is. If it kept the
/// limit before, it is shown meanwhile, and one look is enough in this frame. If the light shines
/// on a small part of the picture, look there, too.
/// @return true if it is clear
bool TechniqueChoice::probe(const CastingLight& casting, double limit, LightChoice& choice)
{
  WrongProbes& found = choice.probing.found;
  const std::size_t before = found.asked;
  bool isClear = false;
  bool isAimed = false;
  bool goesOn = false;
  do
  {
    this->look();
    const WrongProbes wrong =
      this->probes_.wrongOf(*casting.own->as<PointwiseTechnique>(), casting.light,
        this->frame_.space, this->occluders_, this->visibility_.tracer(), this->shaders_);
    found.asked += wrong.asked;
    found.wrong += wrong.wrong;
    isClear = found.mostShare() <= limit || found.leastShare() > limit ||
      ++choice.probing.looks >= mostLooks;
    const bool aims = !isAimed && wrong.asked > 0 && wrong.asked < Probes::count / 4;
    goesOn = !isClear && (aims || !choice.isProbed);
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
  this->frame_.report.probes += static_cast<std::int64_t>(found.asked - before);
  return isClear;
}

//------------------------------------------------------------------------------
/// Choose the first step of an area light, from the present one on, that keeps the error: hard
/// shadows of its centre, or its fewest samples.
void TechniqueChoice::takeSamples(CastingLight& casting)
{
  const double limit = this->frame_.wishes.maximumSoftError;
  LightChoice& choice = this->lights_[casting.light.sceneIndex];
  choice.samples = 0;
  if (!casting.light.area || limit == 0.0)
  {
    return;
  }
  const ShadowLight asked = casting.light;
  for (;; ++choice.step)
  {
    choice.samples = std::min(samplesOf(std::max(choice.step, 1)), asked.lightSamples);
    casting.light.lightSamples = choice.samples;
    const bool isHard = choice.step == 0;
    if (isHard &&
      (asked.texture || !this->frame_.lights.takeCentre(casting, this->frame_.report).empty()))
    {
      continue;
    }
    const bool hasAll = !isHard && choice.samples == asked.lightSamples;
    if (hasAll || (choice.isProbed && choice.sinceProbed < framesPerProbe))
    {
      return;
    }
    choice.sinceProbed = 0;
    choice.isProbed = this->keepsError(casting.light, asked, limit);
    if (choice.isProbed)
    {
      return;
    }
    this->frame_.lights.takeResting(casting, this->frame_.report);
  }
}

//------------------------------------------------------------------------------
/// Probe an area light's visibility, traced from another light, until it is clear on which side of
/// a limit its error is.
/// @return true if it is clear that it keeps the limit
bool TechniqueChoice::keepsError(const ShadowLight& other, const ShadowLight& light, double limit)
{
  SquaredErrors found;
  bool isClear = false;
  for (std::size_t looks = 0; looks < mostSoftLooks && !isClear; ++looks)
  {
    this->looked_ = this->looked_ && looks == 0;
    this->look();
    found.add(this->probes_.errorsOf(other, light, this->occluders_, this->visibility_.tracer()));
    isClear = found.mostRms() <= limit || found.leastRms() > limit;
  }
  this->frame_.report.probes += static_cast<std::int64_t>(found.points);
  return found.mostRms() <= limit;
}

//------------------------------------------------------------------------------
/// Make an area light's first frame at rest show as many samples as in motion.
void TechniqueChoice::refine(CastingLight& casting)
{
  const int samples = this->lights_[casting.light.sceneIndex].samples;
  casting.firstSamples = this->frame_.mayRefine ? samples : 0;
}

//------------------------------------------------------------------------------
/// Find pixels to probe: the same ones for all probes of a frame, unless `looked_` is false.
void TechniqueChoice::look()
{
  if (!this->looked_)
  {
    this->visibility_.updateTracer();
    this->probes_.look(this->frame_.camera, this->frame_.size, this->occluders_,
      this->visibility_.tracer(), this->looks_++);
    this->looked_ = true;
  }
}

//------------------------------------------------------------------------------
void TechniqueChoice::endFrame(double milliseconds)
{
  const FrameReport& report = this->frame_.report;
  for (const LightReport& light : report.lights)
  {
    const auto known = this->lights_.find(light.sceneIndex);
    const int tiles = light.tilesLit + light.tilesDark + light.tilesTraced;
    if (known != this->lights_.end() && tiles > 0)
    {
      known->second.tracedShare = static_cast<double>(light.tilesTraced) / tiles;
    }
  }
  if (report.newPrograms > 0 || report.bvhBuilds > 0)
  {
    this->slowness_.drop();
  }
  this->slowness_.end(milliseconds);
}

} // namespace gnomon
