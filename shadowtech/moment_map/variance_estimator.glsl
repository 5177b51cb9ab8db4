// Variance shadow maps (Donnelly and Lauritzen 2006). VARIANCE_FLOOR_LIGHT is a square of depths in
// [0, 1].

#include "shadowtech/moment_map/moment_map.glsl"
#include "shadowtech/moment_map/chebyshev.glsl"

float estimate_LIGHT(ViewPoint point, float slack)
{
  vec4 moments = momentsAt_LIGHT(point);
  float variance = max(moments.y - moments.x * moments.x, 4.0 * VARIANCE_FLOOR_LIGHT);
  return withoutBleeding_LIGHT(
    chebyshevBound(moments.x, variance, centredDepth_LIGHT(point, slack)));
}
