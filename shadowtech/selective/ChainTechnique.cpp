#include "shadowtech/selective/ChainTechnique.h"

#include "lights/LightSamples.h"
#include "lights/LightSpace.h"
#include "shadowtech/selective/LightInCaster.h"

namespace gnomon
{
namespace
{

TechniqueInfo infoOfChain(const char* name)
{
  TechniqueInfo info;
  info.name = name;
  info.settings = { &viewSettings(), &coherenceSettings() };
  info.classes = classesOfChain();
  return info;
}

std::string refusedByCoherence(const ShadowLight& light)
{
  return light.coherence.texels == 0
    ? "'coherence' decides pixels by texels that agree, and without that traces all of them, as "
      "'raytraced' does; its setting 'coherence' takes 4 or 9"
    : "";
}

std::string refusedBySelective(const ShadowLight& light)
{
  if (light.chain.contourPixels == 0 && light.chain.outside == OutsideContour::Check)
  {
    return "nothing is outside a 'contour' that is the whole image; 'outside' needs a contour of "
           "2, 4 or 6 pixels";
  }
  return light.chain.leftovers == Leftovers::Lit && light.coherence.texels == 0 &&
      light.chain.neighbourTexels == 0 && light.chain.adjacency == Adjacency::Off
    ? "without 'coherence', 'neighbours' and 'adjacency' nothing decides pixels of the contour, "
      "and with 'leftovers' lit all of them would be lit"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
ChainEntry coherence()
{
  TechniqueInfo info = infoOfChain("coherence");
  info.settings.insert(info.settings.end(), { &lightSampleSettings(), &lightSeedSettings() });
  info.seesTextures = true;
  info.refused = { refusedByCoherence, refusedSamples };
  return { std::move(info),
    [](const ShadowSettings& settings)
    {
      ChainStages stages;
      stages.coherenceTexels = settings.coherence.texels;
      stages.rimPoints = 7;
      return stages;
    } };
}

//------------------------------------------------------------------------------
ChainEntry selective()
{
  TechniqueInfo info = infoOfChain("selective");
  info.settings.push_back(&chainSettings());
  info.refused = { refusedBySelective };
  return { std::move(info),
    [](const ShadowSettings& settings)
    {
      ChainStages stages;
      stages.contourPixels = settings.chain.contourPixels;
      stages.outside = settings.chain.outside;
      stages.coherenceTexels = settings.coherence.texels;
      stages.neighbourTexels = settings.chain.neighbourTexels;
      stages.adjacency = settings.chain.adjacency;
      stages.leftovers = settings.chain.leftovers;
      return stages;
    } };
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
  ChainStages stages = this->stagesOf_(input.light);
  const bool soft = input.light.area && stages.rimPoints > 0;
  if (this->lightLiesInCaster(input, soft))
  {
    // No texel shows that caster, so only proofs and rays are correct.
    stages.contourPixels = 0;
    stages.coherenceTexels = 0;
  }
  if (stages.adjacency != Adjacency::Off)
  {
    this->fans_.update(input.occluders, updateFans);
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
