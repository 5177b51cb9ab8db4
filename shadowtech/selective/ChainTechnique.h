#pragma once

#include "lights/LightSamples.h"
#include "lights/LightSpace.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/LightInCaster.h"
#include "shadowtech/selective/RimMaps.h"

#include <optional>
#include <utility>

namespace gnomon
{

inline TechniqueInfo infoOfChain(const char* name)
{
  TechniqueInfo info;
  info.name = name;
  info.settings = { &viewSettings(), &coherenceSettings() };
  info.classes = classesOfChain();
  return info;
}

inline std::string refusedByCoherence(const ShadowLight& light)
{
  return light.coherence.texels == 0
    ? "'coherence' decides pixels by texels that agree, and without that traces all of them, as "
      "'raytraced' does; its setting 'coherence' takes 4 or 9"
    : "";
}

inline std::string refusedBySelective(const ShadowLight& light)
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

/// Returns a technique's stages for a light's settings.
using StagesOfSettings = ChainStages (*)(const ShadowSettings& settings);

/// Triangle maps, and a chain of tests that decides pixels by them.
class ChainTechnique : public CpuScreenTechnique
{
public:
  explicit ChainTechnique(StagesOfSettings stagesOf)
    : stagesOf_(stagesOf)
  {
  }

  MapReach mapReach(const ShadowLight&) const override
  {
    MapReach reach;
    reach.squareTexels = 1.5; // nine texels
    return reach;
  }

  void bake(const MapInput& input) override
  {
    const ShadowLight& light = input.light;
    this->rim_.clear();
    this->inCaster_.reset();
    this->maps_.bake(input.views, light.mapSizeTexels, input.occluders,
      light.box ? std::optional(nearFaceCentred(light, input.occluders.frame.centre))
                : std::nullopt);
  }

  std::size_t bytesOfMaps() const override
  {
    return this->maps_.bytes() + this->rim_.bytes() + this->fans_.bytes();
  }

  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override
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

private:
  /// @param soft true to test the light's area rather than its centre
  bool lightLiesInCaster(const ScreenInput& input, bool soft)
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

  StagesOfSettings stagesOf_;
  TriangleMaps maps_;
  RimMaps rim_; ///< for soft shadows
  TriangleFans fans_;
  /// Cached for the maps' casters and light: its area, and whether it lies in a caster. Empty if
  /// not computed.
  std::optional<std::pair<std::optional<LightArea>, bool>> inCaster_;
};

/// One technique of this kind.
struct ChainEntry
{
  TechniqueInfo info;
  StagesOfSettings stagesOf;
};

/// `coherence`: pixels whose texels disagree are traced. All others get their texels' status
/// (Beister, Ernst, Stamminger, A Hybrid GPU-CPU Renderer, 2005).
///
/// For an area light, texels of eight maps must agree: of its centre and of seven points around it.
/// Other pixels are traced with all samples. The technique is not exact, as texels may agree and be
/// wrong.
inline ChainEntry coherence()
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

/// `selective`: tests of increasing cost verify the contour between light and shadow, and undecided
/// pixels are traced (D. L. Moderno, Shadow Mapping and Ray-Tracing). It is exact inside the
/// contour without the test of coherence, and everywhere if the contour is the whole image.
inline ChainEntry selective()
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

} // namespace gnomon
