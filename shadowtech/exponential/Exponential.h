#ifndef gnomon_shadowtech_exponential_Exponential_h
#define gnomon_shadowtech_exponential_Exponential_h

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `exponential`: exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance Shadow
/// Maps", section 7). Variance shadow maps of two functions of depth, exp(c d) and -exp(-c d), the
/// lesser of whose bounds counts. The first makes what lies near the light small beside what lies
/// farther away, so that less light bleeds through; the second bounds what the first lets through
/// where a receiver's own depths differ within the kernel.
///
/// **No exponent overflows.** With d in [-1, 1] the largest number is the first function's mean
/// square, exp(2 c) with c = 40, and twice that on slopes: 1e35. A float ends at 3e38, c at 44. Of the
/// second a smaller c will do: the more it is, the darker are slopes.
class Exponential : public MomentMapTechnique
{
public:
  static TechniqueInfo info();

  /// As in exponential_warps.glsl.
  static constexpr double exponentPositive = 40.0;
  static constexpr double exponentNegative = 5.0;

protected:
  Moments moments() const override;
  std::string estimatorGlsl(const ShadowLight& light) const override;
};

} // namespace gnomon

#endif
