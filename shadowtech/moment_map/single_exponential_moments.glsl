// The mean of exp(c d) over depths d (Annen et al. 2008). Of depths with a small spread it grows by
// half the square of c times the spread; up to a spread of 1 / c, so that nothing overflows.

#include "shadowtech/moment_map/exponential_warps.glsl"

vec4 momentsOf(float depth, float spread)
{
  float exponents = min(exponentPositive * spread, 1.0);
  return vec4(exp(exponentPositive * depth) * (1.0 + 0.5 * exponents * exponents), 0.0, 0.0, 0.0);
}
