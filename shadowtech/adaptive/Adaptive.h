#pragma once

#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// `adaptive`: percentage closer filtering over a jittered disc, which reads few texels where the
/// whole disc is lit or hidden (docs/techniques/pcf.md). Sources: Uralsky, GPU Gems 2, chapter 17;
/// Rzeczkowski, section 3.2.4.
///
/// `early_out` `exact` compares the receiver's plane with the least and the largest depth of blocks
/// of the map around the point. Where the plane is in front of all of a block's casters, or behind
/// them, all of the disc's points agree. Blocks as large as the disc come first. Within these, a
/// plane's own depths may differ by more than the map's push. So blocks of a quarter to half of
/// that size follow.
class Adaptive : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;

private:
  void bakeDiscs(const ShadowLight& light);

  GlTexture discs_; ///< a layer for each point of the disc, a texel for each disc
  int discGrid_ = 0;
  int discSets_ = 0;
  DepthBounds bounds_; ///< empty unless `early_out` is exact
};

} // namespace gnomon
