#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{

class DepthBounds;

/// True if a light's depth maps hold distances along the ray, which are not linear across the
/// light.
bool measuresAlongRay(const ShadowLight& light);

/// The base of techniques with a plain shadow map: one layer of linear depth per view of the light.
/// A technique adds an estimator: GLSL that defines
///     float estimate_LIGHT(ViewPoint point, float slack)
/// for a point that the light reaches and a view sees (map_visibility.glsl). It also states how far
/// around the point it reads the map (mapReach()).
///
/// No bias is tuned. Let p be the receiver and c the centre of a texel that is read, both on the
/// map, with |c - p| within the reach. Depths are compared at c (depth_map.glsl). The receiver's
/// depth there is the nearer of its plane's depth at c and the point's own depth. So the surface
/// baked at c shadows the receiver unless it lies behind one of the two.
///
/// So no plane shadows itself, nor does a convex surface. In a concave corner c may lie on a
/// neighbour that rises towards the light. So the map is pushed back by the most that a caster's
/// depth changes over the reach. docs/theory/depth_maps.md derives that, also for perspective and
/// warps.
///
/// - Neighbours that end within the reach are not accounted for: the flat top of a step is not
///   pushed back, and darkens what lies below it within the reach.
/// - For the same reason a shadow begins at most the reach away from the contact with its caster,
///   if the receiver does not rise towards the light on the shadow's side.
/// - Pushed depths end behind all casters, but before the depth of texels without any: a caster
///   along the rays has an infinite slope, and a plane in perspective may extend past the light's
///   axis.
class DepthMapTechnique : public PointwiseTechnique
{
public:
  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  ///@{
  /// For TechniqueInfo::bytesPerTexel: return the bytes of depths, alone and with their bounds
  /// (DepthBounds.h).
  static double bytesPerTexel(const ShadowLight& light);
  static double bytesPerTexelWithBounds(const ShadowLight& light);
  ///@}
  std::string visibilityGlsl(const ShadowLight& light) const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

protected:
  const SizedTexture& map() const { return this->map_; }
  /// Return the views of the last bake.
  const LightViews& views() const { return this->views_; }
  /// Return the reach of the last bake.
  const MapReach& reach() const { return this->reach_; }
  /// Build the pyramid of the baked map's depths.
  void bakeBounds(DepthBounds& bounds, ShaderLibrary& shaders) const;

  /// Return the estimator's source. It includes depth_map.glsl.
  virtual std::string estimatorGlsl(const ShadowLight& light) const = 0;

private:
  void bakeMidpoints(const MapInput& input);

  SizedTexture map_;
  GlFramebuffer framebuffer_;
  LightViews views_;        ///< as baked
  MapReach reach_;          ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
