#ifndef gnomon_shadowtech_nsm_Nsm_h
#define gnomon_shadowtech_nsm_Nsm_h

#include "shadowtech/base/Technique.h"

namespace gnomon
{

/// `nsm`: the plain shadow map. Uniform projections, one layer of linear depth for each of the
/// light's views, one comparison at the nearest texel.
///
/// No bias is tuned. The comparison follows the receiver's plane to the texel's centre
/// (nsm_visibility.glsl), which frees planes and convex surfaces from shadowing themselves. What is
/// left are concave corners: there the texel's centre may lie on a neighbour that rises towards the
/// light. Between the centre and the crease, which is no further than the texel's border, its depth
/// grows by at most half the sum of its slopes per texel in x and y, so the map is pushed back by
/// that.
class Nsm : public Technique
{
public:
  static TechniqueInfo info();

  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::string visibilityGlsl(const ShadowLight& light) const override;
  std::vector<Uniform> uniforms(const glm::dmat4& centredFromView) const override;

private:
  void allocate(int sizeTexels, int layers);

  GlTexture map_;
  GlFramebuffer framebuffer_;
  int sizeTexels_ = 0;
  int layers_ = 0;
  LightViews views_; ///< as baked
};

} // namespace gnomon

#endif
