#include "plugin/CastingLights.h"

#include "shadowtech/base/TextureMemory.h"

#include <iterator>
#include <utility>

namespace gnomon
{
namespace
{

/// The name of the kernel that an estimator reads a light's map with; empty: it reads it with none.
std::string kernelOf(const TechniqueInfo& info, const ShadowLight& light)
{
  if (!info.filters)
  {
    return "";
  }
  return info.ownKernel.empty() ? findSetting("kernel")->get(light) : info.ownKernel;
}

/// Finds a light's estimator, and completes the light.
const EstimatorEntry& composeIn(ShadowLight& light)
{
  try
  {
    return compose(light);
  }
  catch (const CompositionError& error)
  {
    throw FrameError(nameOf(light) + ": " + error.what());
  }
}

/// Takes back what a light's technique cannot do here, and notes what it does instead.
void settle(
  ShadowLight& light, const TechniqueInfo& info, bool severalViews, std::vector<std::string>& notes)
{
  const int mostSamples = info.averagesMap ? mostMapSamples() : light.mapSamples;
  if (light.mapSamples > mostSamples)
  {
    notes.push_back(nameOf(light) + ": OpenGL draws maps with at most " +
      std::to_string(mostSamples) + " samples of a texel, not " + std::to_string(light.mapSamples));
    light.mapSamples = mostSamples;
  }
  if (info.refines && light.progressiveSamples > 0 && severalViews)
  {
    notes.push_back(nameOf(light) +
      ": 'progressive' refines one view, and the pass draws several (stereo, tiles, renderers): "
      "all of the light's points are in every frame");
    light.progressiveSamples = 0;
  }
  if (light.texture && !info.seesTextures)
  {
    notes.push_back(nameOf(light) + ": '" + light.technique +
      "' shows an even light of its texture's mean colour");
  }
}

LightReport reportOfSkipped(const SkippedLight& skipped)
{
  LightReport report;
  report.sceneIndex = skipped.sceneIndex;
  report.reason = skipped.reason;
  return report;
}

LightReport reportOfCasting(const ShadowLight& light, const TechniqueInfo& info)
{
  LightReport report;
  report.sceneIndex = light.sceneIndex;
  report.casts = true;
  report.technique = light.technique;
  report.estimator = light.estimator;
  report.projection = info.needsMap ? findSetting("projection")->get(light) : "";
  report.mapSizeTexels = info.needsMap ? light.mapSizeTexels : 0;
  report.kernel = kernelOf(info, light);
  report.kernelTexels = info.filters ? light.kernelTexels : 0;
  report.mapSamples = info.averagesMap ? light.mapSamples : 0;
  return report;
}

} // namespace

//------------------------------------------------------------------------------
const Technique* CastingLight::pointwiseOn(Route route, bool translucentReceivers)
{
  const bool pointwise = this->own.info().isPointwise();
  if (pointwise || !translucentReceivers)
  {
    this->plain.reset();
    return pointwise && (translucentReceivers || route == Route::Inline) ? &this->own.technique()
                                                                         : nullptr;
  }
  if (!this->plain)
  {
    this->plain.emplace(*findTechnique(plainTechnique)->estimator);
  }
  return &this->plain->technique();
}

//------------------------------------------------------------------------------
void CastingLights::collect(
  vtkRenderer* renderer, const ShadowSettings& defaults, FrameReport& report)
{
  LightSet set = this->manager_.collect(renderer, defaults);
  const bool severalViews = this->viewCount_.areSeveral(renderer);

  std::vector<const EstimatorEntry*> estimators;
  for (ShadowLight& light : set.casting)
  {
    estimators.push_back(&composeIn(light));
    settle(light, estimators.back()->info, severalViews, report.notes);
    report.lights.push_back(reportOfCasting(light, estimators.back()->info));
  }
  std::transform(
    set.skipped.begin(), set.skipped.end(), std::back_inserter(report.lights), reportOfSkipped);
  std::sort(report.lights.begin(), report.lights.end(),
    [](const LightReport& a, const LightReport& b) { return a.sceneIndex < b.sceneIndex; });

  // Nothing below fails half way: what a light has kept goes on with it.
  std::vector<CastingLight> lights;
  int layer = 0;
  for (std::size_t i = 0; i < set.casting.size(); ++i)
  {
    lights.push_back(this->take(std::move(set.casting[i]), *estimators[i]));
    lights.back().layer = layer;
    layer += lights.back().channels;
  }
  this->lights_ = std::move(lights);
}

//------------------------------------------------------------------------------
/// A light with the techniques that the frame before had for it, or with new ones.
CastingLight CastingLights::take(ShadowLight light, const EstimatorEntry& estimator)
{
  const auto kept = std::find_if(this->lights_.begin(), this->lights_.end(),
    [&](const CastingLight& casting) { return casting.light.sceneIndex == light.sceneIndex; });
  const int channels = channelsOf(estimator.info, light);
  if (kept != this->lights_.end() && &kept->own.estimator() == &estimator)
  {
    return { std::move(light), std::move(kept->own), std::move(kept->plain), 0, channels };
  }
  return { std::move(light), LightTechnique(estimator), std::nullopt, 0, channels };
}

//------------------------------------------------------------------------------
int CastingLights::layers() const
{
  return this->lights_.empty() ? 0 : this->lights_.back().layer + this->lights_.back().channels;
}

//------------------------------------------------------------------------------
LightReport& reportOf(FrameReport& report, const ShadowLight& light)
{
  return *std::find_if(report.lights.begin(), report.lights.end(),
    [&](const LightReport& of) { return of.sceneIndex == light.sceneIndex; });
}

} // namespace gnomon
