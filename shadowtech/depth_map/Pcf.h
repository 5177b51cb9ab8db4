#pragma once

#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"

#include <string>

namespace gnomon
{

/// `compare`: one comparison with the map, at the nearest texel (Williams 1978).
class Compare : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

/// `pcf` and `adaptive`: the plain shadow map with percentage closer filtering (Reeves, Salesin and
/// Cook 1987; docs/techniques/pcf.md). Visibility is a weighted mean of comparisons with the texels
/// of the light's kernel, each made where its texel was sampled (DepthMapTechnique.h).
///
/// On warped maps, and with `kernel_width`, a kernel's size counts kernel units (Kernel.h).
/// Bilinear and castano weigh all texels in the kernel's shape; with `kernel_width` they use n x n
/// bilinear look-ups, a unit apart. Box, poisson and the disc read the texel at each of their
/// points.
///
/// Texels outside of the layer hold no casters, unless the kernel is larger than the border that
/// the view could reserve (half of the map at most). Then the layer's last texel stands in.
///
/// The jittered disc reads few texels where all of it is lit or hidden (Uralsky, GPU Gems 2,
/// chapter 17; Rzeczkowski, section 3.2.4). `early_out` `exact` compares the receiver's plane with
/// the least and the largest depth of blocks of the map around the point. Where the plane is in
/// front of all of a block's casters, or behind them, all of the disc's points agree. Blocks as
/// large as the disc come first. Within these, a plane's own depths may differ by more than the
/// map's push. So blocks of a quarter to half of that size follow.
class Pcf : public DepthMapTechnique
{
public:
  enum class Kernel
  {
    Chosen,      ///< by the setting `kernel`: `pcf`
    JitteredDisc ///< `adaptive`
  };
  explicit Pcf(Kernel kernel = Kernel::Chosen)
    : isDisc_(kernel == Kernel::JitteredDisc)
  {
  }
  static TechniqueInfo info(Kernel kernel);

  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;

private:
  void bakeDiscs(const AdaptiveSettings& settings);

  bool isDisc_;
  ///@{
  /// Empty unless the kernel is the disc.
  SizedTexture discs_; ///< a layer for each point of the disc, a texel for each disc
  DepthBounds bounds_; ///< empty also unless `early_out` is exact
  ///@}
};

} // namespace gnomon
