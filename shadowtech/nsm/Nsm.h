#ifndef gnomon_shadowtech_nsm_Nsm_h
#define gnomon_shadowtech_nsm_Nsm_h

#include "shadowtech/base/Technique.h"

namespace gnomon
{

/// `nsm`: the plain shadow map. Uniform projection, one depth map, one comparison.
class Nsm : public Technique
{
public:
  static TechniqueInfo info();

  void bake(const MapInput& input) override;
  std::size_t bytesOfMaps() const override;
  std::string visibilityGlsl() const override;
  std::vector<Uniform> uniforms() const override;

private:
  GlTexture map_;
  GlFramebuffer framebuffer_;
  int sizeTexels_ = 0;
  LightView view_;
  ShadowLight light_;
  glm::dvec3 centreWorld_{ 0.0 };
};

} // namespace gnomon

#endif
