// Returns the mean of exp(c d) over depths d (Annen et al. 2008). A small spread adds half the
// square of c times the spread. The spread is limited to 1 / c, so nothing overflows.

#include "shadowtech/moment_map/exponential_warps.glsl"

vec4 momentsOf(float depth, float spread)
{
  float exponents = min(exponentPositive * spread, 1.0);
  return vec4(exp(exponentPositive * depth) * (1.0 + 0.5 * exponents * exponents), 0.0, 0.0, 0.0);
}
