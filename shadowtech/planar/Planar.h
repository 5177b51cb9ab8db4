#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/planar/ReceiverPlanes.h"

#include <cstddef>
#include <cstdint>

namespace gnomon
{

/// `planar`: casters are projected from the light onto receiving planes (Blinn 1988), and rendered
/// there as the camera sees them (docs/techniques/planar.md). Receivers on no such plane show no
/// cast shadow.
class Planar : public GpuScreenTechnique
{
public:
  static TechniqueInfo info();

  void drawVisibility(const LayerInput& input, LightCounts& counts) override;
  std::size_t bytesOfMaps() const override;

private:
  struct Sight;
  struct Batch;

  void allocate(int width, int height);
  std::int64_t findPlanesOfPixels(const LayerInput& input);
  void drawShadows(const LayerInput& input, const Sight& sight, const Batch& batch);
  void sumUp(const LayerInput& input, const Sight& sight, const Batch& batch);
  void noteWhatIsLeftOut(const LayerInput& input) const;

  ReceiverPlanes planes_;
  SizedTexture planesOfPixels_;
  SizedTexture shadows_;
  RunningSum lit_; ///< number of samples that are seen, summed over batches
  GlFramebuffer shadowFramebuffer_;
};

} // namespace gnomon
