#include "plugin/frame/CastingLights.h"

#include "lights/LightViews.h"

namespace gnomon
{
namespace
{

const EstimatorEntry& plainEstimator()
{
  return *findTechnique(plainTechnique)->estimator;
}

const EstimatorEntry& pointEstimator()
{
  return *findTechnique(pointTechnique)->estimator;
}

/// True if a light that leaves its technique to the pass may have a map, in this frame or another:
/// the map must not be one of a larger memory budget.
bool mayTakeMap(const LightPlan& plan)
{
  return plan.asked && plan.asked->mapSizeTexels <= plan.mostMapTexels;
}

} // namespace

const PointwiseTechnique* CastingLight::pointwise() const
{
  if (this->filtered && this->plan.shadedBy != ShadedBy::Fetch)
  {
    return this->filtered.get();
  }
  switch (this->plan.shadedBy)
  {
    case ShadedBy::Own:
      return this->own->as<PointwiseTechnique>();
    case ShadedBy::AtPoints:
      return this->atPoints->as<PointwiseTechnique>();
    case ShadedBy::Fetch:
      break;
  }
  return nullptr;
}

void CastingLights::begin(const std::vector<LightPlan>& lights, TechniqueCache& ofView)
{
  this->lights_.clear();
  this->ofView_ = &ofView;
  for (TechniqueCache* const cache : { &this->ofAllViews_, this->ofView_ })
  {
    cache->dropUnless(
      [&](int sceneIndex, const EstimatorEntry& estimator)
      {
        const auto plan = std::find_if(lights.begin(), lights.end(),
          [&](const LightPlan& of) { return of.light.sceneIndex == sceneIndex; });
        return plan != lights.end() && &this->cacheOf(plan->light) == cache &&
          (plan->estimator == &estimator || plan->resting == &estimator ||
            &estimator == &pointEstimator() ||
            (&estimator == &plainEstimator() && mayTakeMap(*plan)));
      });
  }
}

void CastingLights::take(const std::vector<LightPlan>& lights)
{
  for (const LightPlan& plan : lights)
  {
    LightTechnique& own = this->techniqueOf(plan.light, *plan.estimator);
    CastingLight& casting = this->lights_.emplace_back(CastingLight{ plan, &own });
    if (plan.shadedBy == ShadedBy::AtPoints)
    {
      casting.atPoints = &this->techniqueOf(plan.light, pointEstimator());
      casting.lightOfPoints = lightAtPoints(plan.light);
    }
  }
}

LightTechnique& CastingLights::techniqueOf(
  const ShadowLight& light, const EstimatorEntry& estimator)
{
  return this->cacheOf(light).of(light.sceneIndex, estimator);
}

void CastingLights::endFrame()
{
  for (const CastingLight& casting : this->lights_)
  {
    TechniqueCache& cache = this->cacheOf(casting.light());
    cache.keep(casting.light().sceneIndex, *casting.plan.resting);
    if (mayTakeMap(casting.plan))
    {
      cache.keep(casting.light().sceneIndex, plainEstimator()); // for the next motion
    }
  }
  this->ofAllViews_.dropUnused();
  if (this->ofView_)
  {
    this->ofView_->dropUnused();
  }
}

/// Return the cache of a light's techniques. Maps that are fitted to a camera in every frame belong
/// to one view.
TechniqueCache& CastingLights::cacheOf(const ShadowLight& light)
{
  return isFittedToCamera(light) && light.fit != ViewFit::Once ? *this->ofView_ : this->ofAllViews_;
}

bool smoothsEdges(const CastingLights& lights)
{
  return std::any_of(lights.begin(), lights.end(),
    [](const CastingLight& casting)
    { return casting.edgeSamples() > 1 || casting.plan.edgeSamples > 1; });
}

} // namespace gnomon
