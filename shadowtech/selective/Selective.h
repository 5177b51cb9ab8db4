#ifndef gnomon_shadowtech_selective_Selective_h
#define gnomon_shadowtech_selective_Selective_h

#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

/// `selective`: the contour between light and shadow is looked at closely, by one test after the other
/// (D. L. Moderno, Shadow Mapping and Ray-Tracing), and what they leave is traced. Exact inside of the contour
/// without the test of coherence; everywhere if the contour is the whole image.
class Selective : public ChainTechnique
{
public:
  static TechniqueInfo info();

protected:
  ChainStages stagesOf(const ShadowSettings& settings) const override;
};

} // namespace gnomon

#endif
