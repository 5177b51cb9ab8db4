#ifndef gnomon_shadowtech_moments_FourMoments_h
#define gnomon_shadowtech_moments_FourMoments_h

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `moments`: moment shadow maps (Peters and Klein 2015, "Moment Shadow Mapping"), with four moments in
/// 32-bit floats. The bound is the sharpest that four moments allow: exact for two depths besides the
/// receiver's, so that an occluder before another one lets no light through.
class FourMoments : public MomentMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  Moments moments() const override;
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon

#endif
