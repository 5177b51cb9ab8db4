#pragma once

#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// The disc that is filtered over, in numbers whose squares count.
struct AdaptiveSettings
{
  int discGrid = 8;  ///< points of a disc
  int discSets = 16; ///< discs that differ
};
const SettingsTable& adaptiveSettings();

/// `adaptive`: percentage closer filtering over a jittered disc (Uralsky, GPU Gems 2, chapter 17;
/// Rzeczkowski, section 3.2.4), which reads few texels where all of the disc is lit or hidden
/// (docs/techniques/pcf.md).
///
/// `early_out` `exact` asks the least and the largest depth that the map has in blocks around the
/// point. Where the receiver's plane is in front of all of a block's casters, or behind them, each
/// of the disc's points would say so. First blocks as large as the disc; then, since a plane's own
/// depths differ by more than the map is pushed back within such blocks, those of a quarter to half
/// of that.
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
  DepthBounds bounds_; ///< none where the light does not ask for them
};

} // namespace gnomon
