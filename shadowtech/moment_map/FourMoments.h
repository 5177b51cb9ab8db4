#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `moments`: moment shadow maps (Peters and Klein 2015, "Moment Shadow Mapping"), with four
/// moments in 32-bit floats. The bound is the sharpest that four moments allow: exact for two
/// depths besides the receiver's, so that an occluder before another one lets no light through.
///
/// **Slopes.** Of depths that are spread around the receiver's, half lie before it, and four
/// moments tell. So a receiver must be compared nearer to the light by what its own plane spans
/// within the kernel. Of depths that lie evenly around their mean m with the standard deviation s,
/// the bound is 1 exactly for all that is no farther than m - s: until then the other two depths of
/// which the extreme distribution consists lie behind the first, as they are separated by the roots
/// m - s and m + s of the orthogonal polynomial of second degree. The bias is that s, of the
/// receiver's plane.
class FourMoments : public MomentMapTechnique
{
public:
  static TechniqueInfo info();

protected:
  Moments moments() const override;
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon
