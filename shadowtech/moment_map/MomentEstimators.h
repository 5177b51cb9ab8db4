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

// docs/theory/moment_maps.md says what each bounds, and where receivers are compared on slopes.

/// `single_exponential`: exponential shadow maps with one moment, as in vtkShadowMapPass (Annen,
/// Mertens, Seidel, Flerackers and Kautz 2008, "Exponential Shadow Maps", section 3). Light leaks
/// at contacts, within a few percent of the map's depth range.
MomentEstimator singleExponential();

/// `variance`: variance shadow maps (Donnelly and Lauritzen 2006, "Variance Shadow Maps"). The
/// bound is exact if one plane shadows another, both across the light. If a third plane lies
/// between them, light bleeds through it. Bounds below the setting `bleeding` count as shadow.
///
/// **The variance's floor.** On a flat part of the map, the receiver's depth z and the mean differ
/// by rounding. The difference d is less than 2^-20 of the depth range (CasterDrawing.cpp). A
/// visibility above 0.99 needs a variance of 99 d^2, or 1e-10. Rounding of a variance of 0, up to
/// 2^-23 of [-1, 1] squared, only adds light. So a point is half lit at most as far behind its
/// caster as the root of the floor. For the default of 1e-6, that is 0.1 % of the depth range.
MomentEstimator variance();

/// `exponential`: exponential variance shadow maps (Lauritzen and McCool 2008, "Layered Variance
/// Shadow Maps", section 7): variance shadow maps of two functions of depth, exp(c d) and -exp(-c
/// d), of which the lesser bound counts. The first shrinks depths near the light, so less light
/// bleeds through. The second bounds light that the first lets through where a receiver's own
/// depths differ within the kernel.
///
/// **No exponent overflows.** For d in [-1, 1] the largest number is the first function's mean
/// square, exp(2 c) with c = 40, and twice that on slopes: 1e35. Float ends at 3e38, and c at 44.
/// The second function needs a smaller c only, and a larger one darkens slopes.
MomentEstimator exponential();

/// `moments`: moment shadow maps with four moments in 32-bit floats (Peters and Klein 2015, "Moment
/// Shadow Mapping"). The bound is the sharpest that four moments allow, so an occluder before
/// another one lets no light through.
MomentEstimator fourMoments();

} // namespace gnomon
