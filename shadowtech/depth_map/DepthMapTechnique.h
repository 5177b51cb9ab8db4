#pragma once

#include "shadowtech/base/Technique.h"

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
/// - A plane never shadows itself, however far c is: the plane's depth at c is what was drawn
///   there. Nor does a convex surface, which lies behind each of its tangent planes.
/// - In a concave corner c may lie on a neighbour that rises towards the light. Let s be the
///   gradient of the neighbour's depth at c, and q the place where the crease cuts the way from p
///   to c. From c back to q, which is no farther than p, the neighbour's depth grows by at most
///       h(s) = max of |s . (c - p)| over the reach
///            = square * (|s.x| + |s.y|) + disc * length(s),
///   the support function of the reach. So a map that is pushed back by h is at c no nearer than
///   the crease is at q. The crease lies on the receiver's plane, which between p and c is nowhere
///   nearer than at both of them. The bias grows with the kernel as the crease's distance does. In
///   perspective, 1 / depth is affine on a plane instead: pushed back, depth is
///   1 / (1 / depth - h(gradient of 1 / depth)).
/// - A warped view is a homography to the map from the plane across the light, on which depth (in
///   perspective its inverse) is affine. Let k(t) be the last coordinate of the inverse homography,
///   which is affine on the map. Then the way from c to p across the light is the derivative's at c
///   times k(c) / k(p), exactly. So h is multiplied by the greatest k(c) / k(p) within the reach,
///   and once more because the slope at c is itself a difference from one texel to the next.
/// - Neighbours that end within the reach are not accounted for: the flat top of a step is not
///   pushed back, and darkens what lies below it within the reach.
/// - For the same reason a shadow begins at most the reach away from the contact with its caster,
///   if the receiver does not rise towards the light on the shadow's side.
///
/// Degenerate cases: a caster along the rays has an infinite slope, and a plane in perspective may
/// extend past the light's axis. Pushed depths end behind all casters, but before the depth of
/// texels without any.
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
  const GlTexture& map() const { return this->map_; }
  /// Return the views of the last bake.
  const LightViews& views() const { return this->views_; }
  /// Return the reach of the last bake.
  const MapReach& reach() const { return this->reach_; }
  /// Build the pyramid of the baked map's depths.
  void bakeBounds(DepthBounds& bounds, ShaderLibrary& shaders) const;

  /// Return the estimator's source. It includes depth_map.glsl.
  virtual std::string estimatorGlsl(const ShadowLight& light) const = 0;

private:
  void allocate(int sizeTexels, int layers);
  void bakeMidpoints(const MapInput& input);

  GlTexture map_;
  GlFramebuffer framebuffer_;
  int sizeTexels_ = 0;
  int layers_ = 0;
  LightViews views_;        ///< as baked
  MapReach reach_;          ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
