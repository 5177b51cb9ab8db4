#ifndef gnomon_shadowtech_nsm_Nsm_h
#define gnomon_shadowtech_nsm_Nsm_h

#include "shadowtech/depth_map/DepthMapTechnique.h"

namespace gnomon
{

/// `nsm`: the plain shadow map. Uniform projections, depth, one comparison at the nearest texel.
class Nsm : public DepthMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon

#endif
