#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/RimMaps.h"

#include <optional>
#include <string>
#include <utility>

namespace gnomon
{

/// The base of `coherence` and `selective`: triangle maps, and a chain of tests that decides pixels
/// by them. A technique chooses the stages.
class ChainTechnique : public CpuScreenTechnique
{
public:
  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override;

protected:
  virtual ChainStages stagesOf(const ShadowSettings& settings) const = 0;
  /// Return the common part of info().
  static TechniqueInfo infoOf(const std::string& name);

private:
  bool lightLiesInCaster(const ScreenInput& input, bool soft);

  TriangleMaps maps_;
  RimMaps rim_; ///< for soft shadows
  TriangleFans fans_;
  /// Cached for the maps' casters and light: its area, and whether it lies in a caster. Empty if
  /// not computed.
  std::optional<std::pair<std::optional<LightArea>, bool>> inCaster_;
};

} // namespace gnomon
