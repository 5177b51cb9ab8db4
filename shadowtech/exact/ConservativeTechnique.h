#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/exact/ConservativeMaps.h"

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

  void bake(const MapInput& input) override;
  void dropMaps() override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override;

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
TechniqueInfo infoOfExact(const std::string& name);

/// The exact techniques for hard shadows. They differ in which casters must cover a texel:
/// - `crsm`: one triangle contains it (conservative shadow maps after Hertel et al. 2009, with
///   correct depth bounds).
/// - `crsma`: a triangle and its neighbours contain it (adjacency after Morais 2016, with a border
///   and correct depth bounds).
/// - `silhouette`: the texel holds no edge at which the casters' surface ends.
const std::vector<ConservativeEntry>& exactTechniques();

} // namespace gnomon
