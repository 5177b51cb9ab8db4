#pragma once

#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

namespace gnomon
{

/// `pcss`: percentage closer soft shadows of area lights from one map, as seen by the light's
/// centre (Fernando 2005; Apelles, section 3.4.1).
///
/// All widths are metric, by similar triangles. Let L be a point of the light, relative to its
/// centre and in its plane. Let r be the receiver's distance from the light, and z that of a caster
/// that hides L from the receiver. The caster lies away from the receiver, across the light, by
///     L s,   s = 1 / z - 1 / r   in slopes of a positional light's rays,
///            s = r - z           of a directional light, where L are tangents of angles.
/// s is the caster's *separation*. So one kernel, the light's own shape, serves both steps and all
/// projections. The map's Jacobian at the receiver converts it to texels.
///
/// In a cube the light is seen in three dimensions from its middle. Separations there are r times
/// those above. They are separations of directions
///     P + L s,   s = r / z - 1,
/// from the receiver P at s = 0 towards L, each on the face that sees it (light_around.glsl).
///
/// 1. Blocker search: tests `pcss_samples` points of the light at the largest separation S of a
///    caster around, and the receiver's own texel. S comes from the map's pyramid of depths
///    (DepthBounds.h). Blockers are texels in front of the receiver's plane, between it and some
///    point of the light: L S = L' s for an L' of the light.
/// 2. Penumbra: the least of the blockers' separations, and their mean over the map. If no blocker
///    is found, the filter's points search, too.
/// 3. Filter: the share of the light whose points find texels that hide the receiver. Points are
///    looked up at the least separation, and at the mean if that differs. A caster found at another
///    separation hides another point. So the point is looked up again at that separation, a few
///    times at most.
///
/// docs/techniques/pcss.md gives the reasons. Lights without area get the hard shadow of `compare`.
class Pcss : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

  /// Return a light whose cube has all faces, none fitted to receivers. Rays around an area light
  /// cross to other faces.
  ShadowLight lightOfMap(const ShadowLight& light) const override;
  MapReach mapReach(const ShadowLight& light) const override;
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;

private:
  DepthBounds bounds_; ///< empty for lights without area
  PcssPoints points_;  ///< points of the light's shape
};

} // namespace gnomon
