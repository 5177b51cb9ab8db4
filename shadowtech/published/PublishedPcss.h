#pragma once

#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

namespace gnomon
{

/// `pcss` by the letter of Apelles' listings (4.8 to 4.11; its sections 3.4.1 and 4.1.3), to show
/// its figures: what `as_published` makes of it. With w the light's width, z_r the receiver's
/// distance from the light's centre, and K x K points of a step:
///
/// 1. Blocker search within w (1 + 1 / K): that is (z_r - z_n) / z_r w for a near plane z_n at the
///    light, where these maps' linear depths begin. Blockers are texels nearer than the receiver;
///    without any it is lit.
/// 2. Penumbra: w_p = (z_r - z_b) / z_b w, z_b the blockers' mean distance.
/// 3. Filter within w_p (1 + 1 / K): the share of the texels that are not nearer than the receiver.
///
/// docs/techniques/published.md says what becomes of that. Of spot lights whose map is a single
/// view, rectangles being taken for disks of their longer side. Lights without area have the hard
/// shadow of `compare`.
class PublishedPcss : public DepthMapTechnique
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
  PcssPoints points_; ///< of a disk
  double widthLight_ = 0.0;
};

} // namespace gnomon
