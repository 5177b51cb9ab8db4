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
/// Rzeczkowski, section 3.2.4), which reads few texels where all of the disc is lit or hidden.
///
/// The disc's diameter is `kernel_size` (or `kernel_width`), its points are `disc_grid` squared.
/// There are `disc_sets` squared discs; which of them a place of the map gets repeats every
/// `disc_sets` cells, a quarter of a texel wide, along either axis. Since the disc belongs to the
/// place and not to the pixel, the noise stays on the surface when the camera moves.
///
/// What is asked before the whole disc is read (`early_out`):
/// - `ring`: the first `disc_grid` points, which lie on the outermost ring. Where they agree they
///   are believed. Lit gaps amid shadow, and casters amid light, are missed where the ring does not
///   touch them.
/// - `exact`: the least and the largest depth that the map has in blocks around the point. Where
///   the receiver's plane is in front of all of a block's casters, or behind them, each of the
///   disc's points would say so. First blocks as large as the disc, at most 2 x 2 of them; then,
///   since a plane's own depths differ by more than the map is pushed back within such blocks,
///   those of a quarter to half of that, at most 5 x 5. The result is that of the whole disc.
///   Euclidean depths are not bounded by those of a block's corners: there the whole disc is read.
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
