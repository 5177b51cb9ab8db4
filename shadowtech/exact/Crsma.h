#ifndef gnomon_shadowtech_exact_Crsma_h
#define gnomon_shadowtech_exact_Crsma_h

#include "shadowtech/exact/ConservativeTechnique.h"

namespace gnomon
{

/// `crsma`: exact hard shadows. A texel is covered where a triangle and its neighbours contain it (conservative shadow
/// maps with adjacency after Morais 2016, with a border and depth bounds that hold).
class Crsma : public ConservativeTechnique
{
public:
  static TechniqueInfo info();

protected:
  MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const override;
};

} // namespace gnomon

#endif
