#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/exact/ConservativeMaps.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <string>
#include <vector>

namespace gnomon
{

/// Returns how to bake a technique's maps for a light's settings.
using RuleOfSettings = MapRule (*)(const ShadowSettings& settings);

/// Conservative maps decide which receivers are certainly lit or in shadow. All others get their
/// shadow ray.
class ConservativeTechnique : public CpuScreenTechnique
{
public:
  explicit ConservativeTechnique(RuleOfSettings rule)
    : rule_(rule)
  {
  }

  void bake(const MapInput& input) override
  {
    this->maps_.bake(input.light, input.views, input.occluders, this->rule_(input.light));
  }

  void dropMaps() override { this->maps_.clear(); }

  std::size_t bytesOfMaps() const override { return this->maps_.bytes(); }

  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override
  {
    counts.tracedPixels = static_cast<std::int64_t>(
      input.tracer.trace(input.light, input.occluders, input.receivers, visibility,
        input.usesMap ? &this->maps_ : nullptr, input.classes, input.tiles, input.verdicts));
    counts.rays = counts.tracedPixels;
  }

private:
  RuleOfSettings rule_;
  ConservativeMaps maps_;
};

/// One technique of this kind, as a table has it.
struct ConservativeEntry
{
  TechniqueInfo info;
  RuleOfSettings rule;
};

/// Return the description of a technique whose rule is never wrong.
inline TechniqueInfo infoOfExact(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.exact = true;
  info.settings = { &viewSettings(), &bakeSettings(), &edgeSettings() };
  info.classes = classesOfTracing();
  info.mapIsOptional = true;
  info.conservativeMap = true;
  return info;
}

/// The exact techniques for hard shadows. They differ in which casters must cover a texel:
/// - `crsm`: one triangle contains it (conservative shadow maps after Hertel et al. 2009, with
///   correct depth bounds).
/// - `crsma`: a triangle and its neighbours contain it (adjacency after Morais 2016, with a border
///   and correct depth bounds).
/// - `silhouette`: the texel holds no edge at which the casters' surface ends.
inline const std::vector<ConservativeEntry>& exactTechniques()
{
  static const std::vector<ConservativeEntry> entries = []
  {
    TechniqueInfo crsm = infoOfExact("crsm");
    crsm.asPublished = "crsm_as_published";
    crsm.settings.push_back(&publishedSettings());
    TechniqueInfo crsma = infoOfExact("crsma");
    crsma.asPublished = "crsma_as_published";
    crsma.settings.insert(crsma.settings.end(), { &crsmaSettings(), &publishedSettings() });
    return std::vector<ConservativeEntry>{
      { crsm, [](const ShadowSettings&) { return certainRule(Covering::Triangle); } },
      { crsma,
        [](const ShadowSettings& settings)
        {
          const bool fan = settings.crsma.ring == AdjacencyRing::Vertices;
          return certainRule(fan ? Covering::Fan : Covering::Ring);
        } },
      { infoOfExact("silhouette"),
        [](const ShadowSettings&) { return certainRule(Covering::Silhouette); } },
    };
  }();
  return entries;
}

} // namespace gnomon
