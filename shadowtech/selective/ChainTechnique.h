#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/RimMaps.h"

#include <optional>
#include <utility>

namespace gnomon
{

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

  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override;

private:
  bool lightLiesInCaster(const ScreenInput& input, bool soft);

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
ChainEntry coherence();

/// `selective`: tests of increasing cost verify the contour between light and shadow, and undecided
/// pixels are traced (D. L. Moderno, Shadow Mapping and Ray-Tracing). It is exact inside the
/// contour without the test of coherence, and everywhere if the contour is the whole image.
ChainEntry selective();

} // namespace gnomon
