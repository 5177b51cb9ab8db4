#ifndef gnomon_shadowtech_exact_Silhouette_h
#define gnomon_shadowtech_exact_Silhouette_h

#include "shadowtech/exact/ConservativeTechnique.h"

namespace gnomon
{

/// `silhouette`: exact hard shadows. Casters cover a texel where no edge of their surface is.
class Silhouette : public ConservativeTechnique
{
public:
  static TechniqueInfo info();

protected:
  MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const override;
};

} // namespace gnomon

#endif
