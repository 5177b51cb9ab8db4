#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// `exponential`: exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance
/// Shadow Maps", section 7). Variance shadow maps of two functions of depth, exp(c d) and -exp(-c
/// d), the lesser of whose bounds counts. The first makes what lies near the light small beside
/// what lies farther away, so that less light bleeds through; the second bounds what the first lets
/// through where a receiver's own depths differ within the kernel.
///
/// **Slopes.** Of a plane, the mean of the first function, which is convex, lies beyond the
/// function of the mean depth: on the lit side. The second is concave, and a receiver must be
/// compared nearer to the light by what that makes of its own plane. Along one axis of the map let
/// its depth change by 2 x / c over the kernel: the mean is exp(-c d) sinh(x) / x, and the depth
/// with that value is nearer by ln(sinh(x) / x) / c, which is no more than x^2 / (6 c), nor than x
/// / c.
///
/// **No exponent overflows.** With d in [-1, 1] the largest number is the first function's mean
/// square, exp(2 c) with c = 40, and twice that on slopes: 1e35. A float ends at 3e38, c at 44. Of
/// the second a smaller c will do: the more it is, the darker are slopes.
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
