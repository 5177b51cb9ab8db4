#ifndef gnomon_shadowtech_exact_Crsm_h
#define gnomon_shadowtech_exact_Crsm_h

#include "shadowtech/exact/ConservativeTechnique.h"

namespace gnomon
{

/// `crsm`: exact hard shadows. A texel is covered where one triangle contains it (conservative shadow maps after Hertel et al. 2009, with depth bounds that hold).
class Crsm : public ConservativeTechnique
{
public:
  static TechniqueInfo info();

protected:
  MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const override;
};

} // namespace gnomon

#endif
