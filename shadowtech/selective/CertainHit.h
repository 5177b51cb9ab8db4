#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/selective/TriangleMap.h"

namespace gnomon
{

struct Occluders;

/// Whether a triangle stops a shadow ray for certain, so that a tracer in float finds it blocked,
/// too. A miss proves nothing.
///
/// The ray O + t D is held against the triangle v0, v1, v2, relative to O, in double precision.
/// With u = 2^-24, R the magnitude of O and of the farthest vi, and h the longest edge, a tracer in
/// float
/// - moves vertices by rounding to u R, and each edge function (vi x vj).D by up to 2 sqrt(3) u R
///   times what the edge's ends are off the ray, which is h at most, times |D|;
/// - rounds the functions' products and sums: less than 24 u R h |D|;
/// - rounds T = v0.N and N.D, N the cross product of two edges, to less than 24 u R h^2 and 24 u
/// h^2 |D|. A hit counts where the edge functions are of one sign and at least 64u R h |D|, and T
/// and, where the ray ends at t = e, e N.D - T are at least 64 u h^2 (R + e |D|) on the side where
/// the ray goes. N.D is the sum of the edge functions, and so needs no bound of its own. Rays are
/// rounded again for instances, by up to 8 times as much (instanceNoise() of ShadowRay.h, with a
/// skewness of 2), in proportion to where instances stand as well.
///
/// Triangles with a cut-out never count, as the ray may go through a hole. Of one-sided ones only
/// the front does.
bool certainlyStops(
  const Occluders& occluders, const CasterTriangle& caster, const ShadowRay& ray, float rayFar);

} // namespace gnomon
