#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/TriangleMaps.h"

namespace gnomon
{

struct Occluders;

/// Return true if a triangle certainly stops a shadow ray, so that a float tracer finds it blocked,
/// too. A miss proves nothing.
///
/// The ray O + t D is tested in double precision, relative to O. Let u = 2^-24, R the magnitude of
/// O and of the farthest corner, h the longest edge, and N the cross product of two edges. A float
/// tracer moves edge functions by up to 2 sqrt(3) u R |D| h, and rounds their sums by less than 24
/// u R h |D|; it rounds v0.N and N.D to less than 24 u R h^2 and 24 u h^2 |D|. A hit counts if all
/// of them exceed 64 u (docs/theory/blockers.md). Rays of instances are rounded again, by up to 8
/// times as much (instanceNoise() of ShadowRay.h, with a skewness of 2).
///
/// Triangles with a cut-out never count, as the ray may go through a hole. One-sided triangles
/// count by their front only.
bool certainlyStops(
  const Occluders& occluders, const CasterTriangle& caster, const ShadowRay& ray, float rayFar);

} // namespace gnomon
