#pragma once

#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// `pcf`: the plain shadow map with percentage closer filtering (Reeves, Salesin and Cook 1987;
/// docs/techniques/pcf.md). Visibility is a weighted mean of comparisons with the texels of the
/// light's kernel, each made where its texel was sampled (DepthMapTechnique.h).
///
/// On warped maps, and with `kernel_width`, a kernel's size counts kernel units (Kernel.h).
/// Bilinear and castano weigh all texels in the kernel's shape; with `kernel_width` they use n x n
/// bilinear look-ups, a unit apart. Box and poisson read the texel at each of their points.
///
/// Texels outside of the layer hold no casters, unless the kernel is larger than the border that
/// the view could reserve (half of the map at most). Then the layer's last texel stands in.
class Pcf : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

  MapReach mapReach(const ShadowLight& light) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
