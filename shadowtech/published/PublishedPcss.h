#pragma once

#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

namespace gnomon
{

/// `pcss` exactly as in Apelles' listings (4.8 to 4.11; sections 3.4.1 and 4.1.3), to reproduce its
/// figures; `as_published` selects it. Let w be the light's width, z_r the receiver's distance from
/// the light's centre, and K x K the points of a step.
///
/// 1. Blocker search within w (1 + 1 / K). That is (z_r - z_n) / z_r w for a near plane z_n at the
///    light, where these maps' linear depths begin. Blockers are texels nearer than the receiver;
///    without any it is lit.
/// 2. Penumbra: w_p = (z_r - z_b) / z_b w, with z_b the blockers' mean distance.
/// 3. Filter within w_p (1 + 1 / K): the share of texels that are not nearer than the receiver.
///
/// docs/techniques/published.md shows the effects. The technique supports spot lights whose map is
/// a single view. Rectangles count as disks of their longer side. Lights without area get the hard
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
  PcssPoints points_; ///< points of a disk
  double widthLight_ = 0.0;
};

} // namespace gnomon
