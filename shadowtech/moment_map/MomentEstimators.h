#pragma once

#include "shadowtech/moment_map/MomentMapTechnique.h"

namespace gnomon
{

///@{
/// Factors of depths in exponents, as in exponential_warps.glsl. `single_exponential` uses the
/// positive one.
constexpr double exponentPositive = 40.0;
constexpr double exponentNegative = 5.0;
///@}

/// `single_exponential`: exponential shadow maps with one moment, as in vtkShadowMapPass (Annen,
/// Mertens, Seidel, Flerackers and Kautz 2008, "Exponential Shadow Maps", section 3).
///
/// Let z be the receiver's depth. The mean of exp(c d) over the kernel, divided by exp(c z), is the
/// lit share if casters lie far before the receiver. A caster `gap` before it lets through exp(-c
/// gap). So light leaks at contacts, within a few percent of the map's depth range.
///
/// No bias is tuned: exp(c d) is convex, so its mean over a plane lies on the lit side.
MomentEstimator singleExponential();

/// `variance`: variance shadow maps (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). Two
/// moments give a mean m and a variance s. By Chebyshev's one-sided inequality, at most s / (s + (z
/// - m)^2) of the depths lie as far as z > m.
///
/// The bound is exact if one plane shadows another, both across the light. If a third plane lies
/// between them, light bleeds through it. Bounds below the setting `bleeding` count as shadow.
///
/// **The variance's floor.** On a flat part of the map, the receiver's depth z and the mean differ
/// by rounding. The difference d is less than 2^-20 of the depth range (CasterDrawing.cpp). A
/// visibility above 0.99 needs s >= 99 d^2, or 1e-10. Rounding of a variance of 0, up to 2^-23 of
/// [-1, 1] squared, only adds light. So a point is half lit at most as far behind its caster as the
/// root of the floor. For the default of 1e-6, that is 0.1 % of the depth range.
MomentEstimator variance();

/// `exponential`: exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance
/// Shadow Maps", section 7). They are variance shadow maps of two functions of depth, exp(c d) and
/// -exp(-c d); the lesser bound counts. The first function shrinks depths near the light compared
/// with farther ones, so less light bleeds through. The second bounds light that the first lets
/// through where a receiver's own depths differ within the kernel.
///
/// **Slopes.** The first function is convex. So its mean over a plane exceeds its value at the mean
/// depth, which is on the lit side. The second is concave, so a receiver must be compared nearer to
/// the light by the effect on its own plane. Let the plane's depth change by 2 x / c over the
/// kernel along one axis of the map. The mean is exp(-c d) sinh(x) / x. The depth with that value
/// is nearer by ln(sinh(x) / x) / c, which is at most x^2 / (6 c) and at most x / c.
///
/// **No exponent overflows.** For d in [-1, 1] the largest number is the first function's mean
/// square, exp(2 c) with c = 40, and twice that on slopes: 1e35. Float ends at 3e38, and c at 44.
/// The second function needs a smaller c only, and a larger one darkens slopes.
MomentEstimator exponential();

/// `moments`: moment shadow maps with four moments in 32-bit floats (Peters and Klein 2015, "Moment
/// Shadow Mapping"). The bound is the sharpest that four moments allow. It is exact for two depths
/// besides the receiver's, so an occluder before another one lets no light through.
///
/// **Slopes.** Half of the depths spread around a receiver's lie before it, and four moments show
/// it. So a receiver must be compared nearer to the light by the spread of its own plane within the
/// kernel. For depths spread evenly around their mean m with standard deviation s, the bound is 1
/// exactly up to m - s. Until then the extreme distribution's other two depths lie behind the
/// first. The roots m - s and m + s of the orthogonal polynomial of second degree separate them. So
/// the bias is s of the receiver's plane.
MomentEstimator fourMoments();

} // namespace gnomon
