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

/// `pcf`: the plain shadow map with percentage closer filtering (Reeves, Salesin and Cook 1987).
/// The visibility is a weighted mean of comparisons with the texels of the light's kernel. Shadows
/// get smooth edges as wide as the kernel, which is no penumbra: they are as wide everywhere.
///
/// | kernel of width n | texels read | reach |
/// |---|---|---|
/// | bilinear | (n + 1) x (n + 1), weighted by how far an n x n square around the point covers them; n = 1 is the usual bilinear filter | square, (n + 1) / 2 |
/// | box | n x n, nearest to the point | square, n / 2 |
/// | castano | (n + 1) x (n + 1), weighted by their distance along either axis (Castano 2013, "Shadow Mapping Summary", The Witness); n is 3, 5 or 7 | square, (n + 1) / 2 |
/// | poisson | 16, nearest to points of a disc of diameter n | square, 1/2, and disc, n / 2 |
///
/// Those are kernels on uniform maps. On warped ones, and with `kernel_width`, n counts kernel
/// units (shadowtech/base/Kernel.h): bilinear and castano weigh all texels in the kernel's shape,
/// and with `kernel_width` n x n bilinear look-ups, a unit apart; box and poisson read the texel at
/// each of their points.
///
/// Each comparison is made where its texel was sampled, so that no kernel makes a surface shadow
/// itself (DepthMapTechnique.h). The disc turns by a random angle from each cell of the map to the
/// next, a quarter of a texel wide; since the angle belongs to the place and not to the pixel, the
/// pattern stays on the surface when the camera moves.
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
