// One comparison at the nearest texel (Williams 1978).

#include "shadowtech/depth_map/depth_map.glsl"

float estimate_LIGHT(ViewPoint point, float slack)
{
  return isLitAt_LIGHT(point, ivec2(point.texel), slack) ? 1.0 : 0.0;
}
