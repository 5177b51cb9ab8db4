#include "plugin/frame/TechniqueChoice.h"

#include "plugin/scene/ShownView.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <utility>

namespace gnomon
{
namespace
{

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
  Frame& frame, const Occluders& occluders, SnapshotTracer& tracer, ShaderLibrary& shaders)
  : frame_(frame)
  , occluders_(occluders)
  , tracer_(tracer)
  , shaders_(shaders)
{
}

//------------------------------------------------------------------------------
AutoFacts TechniqueChoice::facts() const
{
  AutoFacts facts{ {}, this->frame_.moves, this->frame_.mayRefine, this->frame_.severalViews, false,
    0, { this->occluders_.topologyVersion, this->occluders_.positionsVersion },
    this->frame_.triangles, 0, 0, factorsOf(this->frame_.wishes), this->frame_.lights.compose() };
  for (const CastingLight& casting : this->frame_.lights)
  {
    facts.lights.push_back({ casting.light, casting.own->info(), casting.identity,
      casting.asked ? &*casting.asked : nullptr, casting.mostMapTexels });
  }
  hashView(facts.view, this->frame_.camera, this->frame_.size);
  for (const Surface& surface : this->occluders_.surfaces)
  {
    const std::size_t instances = std::max<std::size_t>(surface.centredFromSource.size(), 1);
    facts.drawn += surface.drawnCount() * instances;
    facts.unseenReceiver = facts.unseenReceiver || isUnseenReceiver(surface);
  }
  facts.pixels =
    static_cast<std::size_t>(this->frame_.size.x) * static_cast<std::size_t>(this->frame_.size.y);
  return facts;
}

//------------------------------------------------------------------------------
void TechniqueChoice::choose(const Bake& bake)
{
  const CastingLights& lights = this->frame_.lights;
  if (std::none_of(lights.begin(), lights.end(),
        [](const CastingLight& casting) { return casting.asked.has_value(); }))
  {
    return;
  }
  this->looked_ = false;
  const AutoFacts facts = this->facts();
  std::vector<Evidence> evidence;
  AutoPlan plan = planAuto(facts, this->frame_.wishes, this->history_, evidence);
  while (plan.needs) // each need is another map or number of samples, of which there are few
  {
    evidence.push_back(this->gather(*plan.needs, bake));
    plan = planAuto(facts, this->frame_.wishes, this->history_, evidence);
  }
  this->history_ = std::move(plan.history);
  this->frame_.report.choice = plan.choice;
  for (const AutoChoice& choice : plan.choices)
  {
    this->apply(choice);
  }
}

//------------------------------------------------------------------------------
CastingLight& TechniqueChoice::castingOf(int sceneIndex)
{
  return *std::find_if(this->frame_.lights.begin(), this->frame_.lights.end(),
    [&](const CastingLight& casting) { return casting.light.sceneIndex == sceneIndex; });
}

//------------------------------------------------------------------------------
void TechniqueChoice::apply(const AutoChoice& choice)
{
  CastingLight& casting = this->castingOf(choice.sceneIndex);
  CastingLights& lights = this->frame_.lights;
  FrameReport& report = this->frame_.report;
  switch (choice.way)
  {
    case AutoChoice::Way::Map:
      lights.take(casting, lights.asMap(casting, choice.mapSizeTexels), report);
      break;
    case AutoChoice::Way::Centre:
      lights.take(casting, lights.asCentre(casting), report);
      break;
    case AutoChoice::Way::Resting:
      casting.firstSamples = choice.firstSamples;
      if (choice.lightSamples > 0)
      {
        casting.light.lightSamples = choice.lightSamples;
      }
  }
}

//------------------------------------------------------------------------------
Evidence TechniqueChoice::gather(const EvidenceRequest& request, const Bake& bake)
{
  Evidence evidence;
  const CastingLight& casting = this->castingOf(request.sceneIndex);
  CastingLights& lights = this->frame_.lights;
  if (request.mapSizeTexels == 0)
  {
    ShadowLight other = request.lightSamples > 0 ? casting.light : lights.asCentre(casting).light;
    other.lightSamples = request.lightSamples > 0 ? request.lightSamples : other.lightSamples;
    evidence.keepsError = this->keepsError(other, casting.light, request.errorLimit);
    return evidence;
  }
  const Composition map = lights.asMap(casting, request.mapSizeTexels);
  LightTechnique& technique = lights.techniqueOf(map);
  try
  {
    bake(casting, map.light, technique);
    this->probe(*technique.as<PointwiseTechnique>(), map.light, request, evidence);
  }
  catch (const TextureMemoryError& error)
  {
    evidence.failure = error.what();
  }
  return evidence;
}

//------------------------------------------------------------------------------
/// Probe a light's map until it is clear on which side of a limit its error is. A map that is shown
/// meanwhile has one look in this frame. If the light shines on a small part of the picture, look
/// there, too.
void TechniqueChoice::probe(const PointwiseTechnique& technique, const ShadowLight& map,
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
  this->frame_.report.probes += static_cast<std::int64_t>(found.asked - before);
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
    found.add(this->probes_.errorsOf(other, light, this->occluders_, this->tracer_.get()));
    isClear = found.mostRms() <= limit || found.leastRms() > limit;
  }
  this->frame_.report.probes += static_cast<std::int64_t>(found.points);
  return found.mostRms() <= limit;
}

//------------------------------------------------------------------------------
/// Find pixels to probe: the same ones for all probes of a frame, unless `looked_` is false.
void TechniqueChoice::look()
{
  if (!this->looked_)
  {
    this->tracer_.update();
    this->probes_.look(this->frame_.camera, this->frame_.size, this->occluders_,
      this->tracer_.get(), this->looks_++);
    this->looked_ = true;
  }
}

//------------------------------------------------------------------------------
void TechniqueChoice::endFrame(double milliseconds, bool isUsual)
{
  for (const CastingLight& casting : this->frame_.lights)
  {
    const auto known = this->history_.lights.find(casting.light.sceneIndex);
    if (casting.tracedShare && known != this->history_.lights.end())
    {
      known->second.tracedShare = *casting.tracedShare;
    }
  }
  if (!isUsual)
  {
    this->history_.slowness.drop();
  }
  this->history_.slowness.end(milliseconds);
}

} // namespace gnomon
