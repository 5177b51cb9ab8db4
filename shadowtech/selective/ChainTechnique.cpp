#include "shadowtech/selective/ChainTechnique.h"

#include "lights/LightSpace.h"
#include "shadowtech/selective/LightInCaster.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo ChainTechnique::infoOf(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.settings = { &viewSettings(), &coherenceSettings() };
  info.classes = classesOfChain();
  return info;
}

//------------------------------------------------------------------------------
MapReach ChainTechnique::mapReach(const ShadowLight&) const
{
  MapReach reach;
  reach.squareTexels = 1.5; // nine texels
  return reach;
}

//------------------------------------------------------------------------------
void ChainTechnique::bake(const MapInput& input)
{
  const ShadowLight& light = input.light;
  this->rim_.clear();
  this->inCaster_.reset();
  this->maps_.bake(input.views, light.mapSizeTexels, input.occluders,
    light.box ? std::optional(nearFaceCentred(light, input.occluders.frame.centre)) : std::nullopt);
}

//------------------------------------------------------------------------------
std::size_t ChainTechnique::bytesOfMaps() const
{
  return this->maps_.bytes() + this->rim_.bytes() + this->fans_.bytes();
}

//------------------------------------------------------------------------------
/// @param soft true to test the light's area rather than its centre
bool ChainTechnique::lightLiesInCaster(const ScreenInput& input, bool soft)
{
  const ShadowLight& light = input.light;
  if (light.kind == LightKind::Directional)
  {
    return false;
  }
  // The cache needs no position as its key: maps are baked again when the light moves.
  const std::optional<LightArea> area = soft ? light.area : std::nullopt;
  if (!this->inCaster_ || this->inCaster_->first != area)
  {
    this->inCaster_.emplace(area,
      liesInCaster(light.positionWorld - input.occluders.frame.centre, area ? &*area : nullptr,
        input.occluders));
  }
  return this->inCaster_->second;
}

//------------------------------------------------------------------------------
void ChainTechnique::computeVisibility(
  const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts)
{
  ChainStages stages = this->stagesOf(input.light);
  const bool soft = input.light.area && stages.rimPoints > 0;
  if (this->lightLiesInCaster(input, soft))
  {
    // No texel shows that caster, so only proofs and rays are correct.
    stages.contourPixels = 0;
    stages.coherenceTexels = 0;
  }
  if (stages.adjacency != Adjacency::Off)
  {
    this->fans_.update(input.occluders);
  }
  if (soft)
  {
    input.mapBakes +=
      this->rim_.update(input.light, input.fitting, input.occluders, stages.rimPoints);
  }
  else
  {
    this->rim_.clear();
  }
  const Chain chain(stages, this->maps_, soft ? &this->rim_ : nullptr, this->fans_, input);
  counts.lightSamples = soft ? input.light.lightSamples : 1;
  counts.rays = static_cast<std::int64_t>(chain.run(visibility));
  counts.tracedPixels = counts.rays / counts.lightSamples;
}

} // namespace gnomon
