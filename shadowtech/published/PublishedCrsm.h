#ifndef gnomon_shadowtech_published_PublishedCrsm_h
#define gnomon_shadowtech_published_PublishedCrsm_h

#include "shadowtech/exact/ConservativeTechnique.h"

namespace gnomon
{

/// `crsm` by the letter of its publication (Morais 2016, chapter 4): not exact (PublishedMap.h).
class CrsmAsPublished : public ConservativeTechnique
{
public:
  static TechniqueInfo info();

protected:
  MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const override;
};

/// `crsma` by the letter of the same publication: not exact either.
class CrsmaAsPublished : public ConservativeTechnique
{
public:
  static TechniqueInfo info();

protected:
  MapRule rule(const ShadowSettings& settings, const CellsOnGpu* gpu) const override;
};

} // namespace gnomon

#endif
