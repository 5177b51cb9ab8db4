#pragma once

#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

namespace gnomon
{

/// `pcss`: percentage closer soft shadows (Fernando 2005; Apelles, section 3.4.1) of area lights,
/// from one map that the light's centre sees.
///
/// All widths are metric, by similar triangles. What hides the light's point L (in the light's
/// plane, from its centre) from a receiver at distance r lies, at distance z from the light, across
/// the light by
///     L s,   s = 1 / z - 1 / r   in slopes of a positional light's rays,
///            s = r - z           of a directional light, where L are tangents of angles,
/// away from the receiver: s is its *separation*. So one kernel, the light's own shape, serves both
/// steps and all projections; the map's Jacobian at the point takes it to texels.
///
/// From the middle of a cube a light is looked at in three dimensions. Times r the separation is
/// that of directions
///     P + L s,   s = r / z - 1,
/// for the receiver at P: from the receiver at s = 0 towards L, each on the face that sees it
/// (light_around.glsl).
///
/// 1. Blocker search: `pcss_samples` points of the light, on the map at the largest separation S
///    that a caster around has (from the map's pyramid of depths, DepthBounds.h), and the
///    receiver's own texel. Blockers are texels in front of the receiver's plane that lie between
///    it and some point of the light: L S = L' s for an L' of the light.
/// 2. Penumbra: the least of the blockers' separations, and their mean over the map. Where no
///    blocker is found, the filter's points search, too.
/// 3. Filter: the share of the light whose points, at the least separation or, where that is
///    another depth, at the mean, find texels that hide the receiver. What is found at another
///    separation hides another point, and is looked for again at its own, a few times at most.
///
/// docs/techniques/pcss.md says why. A light without area has the hard shadow of `compare`.
class Pcss : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

  /// Around a light with an area rays go over to other faces of the cube: none of them may be left
  /// out, or be cut to the receivers on it.
  ShadowLight lightOfMap(const ShadowLight& light) const override;
  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;

private:
  DepthBounds bounds_; ///< none of lights without area
  PcssPoints points_;  ///< of the light's shape
};

} // namespace gnomon
