#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/TriangleMap.h"

namespace gnomon
{

struct Occluders;

/// Return true if a triangle certainly stops a shadow ray, so that a float tracer finds it blocked,
/// too. A miss proves nothing.
///
/// The ray O + t D is tested against the triangle v0, v1, v2, relative to O, in double precision.
/// Let u = 2^-24, R the magnitude of O and of the farthest vi, h the longest edge, and N the cross
/// product of two edges. A float tracer
/// - moves vertices by rounding to u R. That moves each edge function (vi x vj).D by up to 2
///   sqrt(3) u R |D| times the distance of the edge's ends from the ray. That distance is at most
///   h;
/// - rounds the functions' products and sums by less than 24 u R h |D|;
/// - rounds T = v0.N and N.D to less than 24 u R h^2 and 24 u h^2 |D|.
///
/// A hit counts if the edge functions have one sign and are at least 64 u R h |D|. T must be at
/// least 64 u h^2 (R + e |D|) on the side to which the ray goes. For rays that end at t = e, so
/// must e N.D - T. N.D is the sum of the edge functions, and so needs no bound of its own.
///
/// Rays are rounded again for instances, by up to 8 times as much (instanceNoise() of ShadowRay.h,
/// with a skewness of 2). This rounding is also proportional to where instances stand.
///
/// Triangles with a cut-out never count, as the ray may go through a hole. One-sided triangles
/// count by their front only.
bool certainlyStops(
  const Occluders& occluders, const CasterTriangle& caster, const ShadowRay& ray, float rayFar);

} // namespace gnomon
