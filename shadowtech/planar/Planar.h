#pragma once

#include "shadowtech/base/RunningSum.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/planar/IntegerTable.h"
#include "shadowtech/planar/ReceiverPlanes.h"

#include <cstddef>
#include <vector>

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
  struct Batch;

  void allocate(int width, int height);
  void sendPlanes(const LayerInput& input);
  void findPlanesOfPixels(const LayerInput& input);
  Batch makeBatch(const LayerInput& input, std::size_t first) const;
  void drawShadows(const LayerInput& input, const Batch& batch);
  void sumUp(const LayerInput& input, const Batch& batch);
  void noteWhatIsLeftOut(const LayerInput& input) const;
  std::int64_t countPixelsOffPlanes() const;

  ReceiverPlanes planes_;
  glm::dvec4 centre_{ 0.0 };        ///< lightPoint()
  std::vector<glm::dvec4> samples_; ///< lightSamples()

  IntegerTable planesOfPrimitives_{ { GL_R8UI, GL_RED_INTEGER, 1, GL_UNSIGNED_BYTE } };
  IntegerTable blocks_{ { GL_RGBA32UI, GL_RGBA_INTEGER, 4, GL_UNSIGNED_INT } };
  int blockCount_ = 0;
  std::uint64_t sentVersion_ = 0; ///< ReceiverPlanes::version() of planesOfPrimitives_

  GlTexture planesOfPixels_;
  GlTexture shadows_;
  RunningSum lit_; ///< number of samples that are seen, summed over batches
  GlFramebuffer shadowFramebuffer_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon
