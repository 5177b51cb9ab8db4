#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

/// Of estimators by variance: no variance counts as less than the floor, in squares of the map's
/// depth range.
struct VarianceSettings
{
  double floor = 1e-6;
};
const SettingsTable& varianceSettings();

///@{
/// What depths are multiplied by in exponents, as in exponential_warps.glsl. The exponential of
/// `single_exponential` is the positive one.
constexpr double exponentPositive = 40.0;
constexpr double exponentNegative = 5.0;
///@}

/// `single_exponential`: exponential shadow maps (Annen, Mertens, Seidel, Flerackers and Kautz
/// 2008, "Exponential Shadow Maps", section 3) with one moment, as vtkShadowMapPass has them.
///
/// The mean of exp(c d) over the kernel, divided by exp(c z) at the receiver's depth z, is the lit
/// share where casters lie far before the receiver. A caster that lies `gap` before it lets through
/// exp(-c gap): light leaks at contacts, within some percent of the map's depth range.
///
/// No bias is tuned: exp(c d) is convex, so its mean over a plane lies on the lit side.
MomentEstimator singleExponential();

/// `variance`: variance shadow maps (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). Two
/// moments, mean m and mean square, and Chebyshev's one-sided inequality: of depths with that mean
/// and a variance s, at most s / (s + (z - m)^2) lie as far as z > m.
///
/// The bound is exact where one plane shadows another, both across the light. Where a third one
/// lies between them, light bleeds through it: what lies below the setting `bleeding` counts as
/// shadow.
///
/// **The variance's floor.** Where the map is flat, the receiver's depth z and the mean differ by
/// rounding, d, which is less than 2^-20 of the depth range (CasterDrawing.cpp). To be lit by more
/// than 0.99, a point needs s >= 99 d^2, or 1e-10. What rounding makes of the variance itself where
/// it is 0, up to 2^-23 of [-1, 1] squared, only adds light: a point is half lit that lies as far
/// behind its caster as the root of the floor, at most; with the default of 1e-6, 0.1 % of the
/// depth range.
MomentEstimator variance();

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
MomentEstimator exponential();

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
MomentEstimator fourMoments();

} // namespace gnomon
