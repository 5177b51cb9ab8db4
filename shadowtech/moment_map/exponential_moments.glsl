// Returns the mean and the mean square of two functions of a depth d (Lauritzen and McCool 2008):
// exp(c d) and -exp(-c d). A spread of depths spreads the functions by their slopes, which are c
// times their values. It is limited to the function's size, so nothing overflows.

#include "shadowtech/moment_map/exponential_warps.glsl"

vec2 warpedMoments(float warped, float exponent, float spread)
{
  float spreadOverWarped = min(exponent * spread, 1.0);
  return vec2(warped, warped * warped * (1.0 + spreadOverWarped * spreadOverWarped));
}

vec4 momentsOf(float depth, float spread)
{
  return vec4(warpedMoments(exp(exponentPositive * depth), exponentPositive, spread),
    warpedMoments(-exp(-exponentNegative * depth), exponentNegative, spread));
}
