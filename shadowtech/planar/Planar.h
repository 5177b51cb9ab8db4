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

struct PlanarSettings
{
  int planes = 8; ///< how many show shadows, at most
};
const SettingsTable& planarSettings();

/// `planar`: casters are projected from the light onto the planes that receive shadows (Blinn
/// 1988), and drawn there as the camera sees them (docs/techniques/planar.md). What lies on no such
/// plane shows no cast shadow.
class Planar : public GpuScreenTechnique
{
public:
  static TechniqueInfo info();

  void drawVisibility(const LayerInput& input, LightReport& report) override;
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
  std::uint64_t sentVersion_ = 0; ///< of planesOfPrimitives_: ReceiverPlanes::version()

  GlTexture planesOfPixels_;
  GlTexture shadows_;
  RunningSum lit_; ///< of several batches: the samples that are seen
  GlFramebuffer shadowFramebuffer_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon
