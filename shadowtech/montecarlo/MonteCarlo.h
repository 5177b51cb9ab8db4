#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/ChannelView.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/montecarlo/DepthLayers.h"
#include "shadowtech/montecarlo/SlabBounds.h"
#include "shadowtech/montecarlo/UndecidedTiles.h"
#include "shadowtech/montecarlo/VisibilityFilter.h"

#include <cstddef>
#include <memory>

namespace gnomon
{

/// `montecarlo`: soft shadows of area lights by a few random rays per pixel. A filter removes their
/// noise. The source is Curtis, *Real-Time Soft Shadows Using Monte Carlo Ray Tracing of Depth
/// Maps*, 2009.
///
/// Rays are traced through depth layers of the light's map. They do not meet triangles, but slabs
/// between two depths in a texel (DepthLayers.h). A hierarchy of bounds skips empty texels
/// (SlabBounds.h).
class MonteCarlo : public GpuScreenTechnique
{
public:
  static TechniqueInfo info();

  ShadowLight lightOfMap(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;

  void drawVisibility(const LayerInput& input, LightCounts& counts) override;

private:
  void allocate(int width, int height, int channels);
  void upload(const std::shared_ptr<const LightTexture>& texture);
  std::vector<Uniform> uniformsOf(const LayerInput& input) const;
  void followRays(const LayerInput& input);
  ChannelView viewOf(int channel) const;
  void readClasses(const LayerInput& input) const;

  LightViews views_;
  double nearest_ = 0.0; ///< the z at which depths of ray space begin (RaySpace.h)
  DepthLayers layers_;
  SlabBounds bounds_;

  SizedTexture lightTexture_;
  std::shared_ptr<const LightTexture> uploaded_; ///< the texture in `lightTexture_`

  SizedTexture unfiltered_; ///< visibility in one channel or three, then the class
  SizedTexture slopes_;     ///< gradients of visibility
  UndecidedTiles undecided_;
  VisibilityFilter filter_;
  ScreenPass screenPass_;
  int channels_ = 1; ///< of visibility
};

} // namespace gnomon
