#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/RimMaps.h"

#include <optional>
#include <string>
#include <utility>

namespace gnomon
{

/// Of `coherence` and `selective`: how many texels around a pixel's place on the map have to agree
/// for the map to be believed; 0: it is not.
struct CoherenceSettings
{
  int texels = 4;
};
const SettingsTable& coherenceSettings();

/// What `coherence` and `selective` share: triangle maps, and a chain of tests that decides pixels
/// by them. A technique says which stages its chain has.
class ChainTechnique : public CpuScreenTechnique
{
public:
  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightReport& report) override;

protected:
  virtual ChainStages stagesOf(const ShadowSettings& settings) const = 0;
  /// What its info() is but for the name.
  static TechniqueInfo infoOf(const std::string& name);

private:
  bool lightLiesInCaster(const ScreenInput& input, bool soft);

  TriangleMaps maps_;
  RimMaps rim_; ///< of soft shadows
  TriangleFans fans_;
  /// Of the maps' casters and light: its area, and whether it lies in a caster. None: not known.
  std::optional<std::pair<std::optional<LightArea>, bool>> inCaster_;
};

} // namespace gnomon
