#pragma once

#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// Which texels around a receiver a filter reads, and with which weights.
enum class FilterKernel
{
  Bilinear, ///< a square of any place: texels count by how far it covers them
  Box,      ///< n x n texels of equal weight
  Poisson,  ///< a few texels of equal weight, scattered over a disc that turns from place to place
  Castano   ///< a square of any place whose texels count the less the farther they are
};
struct PcfSettings
{
  /// The default is the narrowest that shows no single texels (as a box does) and also smooths the
  /// steps of an edge that runs across the texels.
  FilterKernel kernel = FilterKernel::Bilinear;
};
const SettingsTable& pcfSettings();

/// `pcf`: the plain shadow map with percentage closer filtering (Reeves, Salesin and Cook 1987;
/// docs/techniques/pcf.md). The visibility is a weighted mean of comparisons with the texels of the
/// light's kernel, each made where its texel was sampled (DepthMapTechnique.h).
///
/// On warped maps, and with `kernel_width`, a kernel's size counts kernel units (Kernel.h):
/// bilinear and castano weigh all texels in the kernel's shape, and with `kernel_width` n x n
/// bilinear look-ups, a unit apart; box and poisson read the texel at each of their points.
///
/// Texels outside of the layer hold no casters, unless the kernel is larger than the border that
/// the view could keep (half of the map at most): then the layer's last texel stands in.
class Pcf : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

  MapReach mapReach(const ShadowLight& light) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
