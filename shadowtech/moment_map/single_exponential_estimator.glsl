// Exponential shadow maps (Annen et al. 2008, equation 7).

#include "shadowtech/moment_map/exponential_warps.glsl"
#include "shadowtech/moment_map/moment_map.glsl"

float estimate_LIGHT(ViewPoint point, float slack)
{
  float receiver = exp(exponentPositive * centredDepth_LIGHT(point, slack));
  return withoutBleeding_LIGHT(min(momentsAt_LIGHT(point).x / receiver, 1.0));
}
