// Exponential variance shadow maps (Lauritzen and McCool 2008). VARIANCE_FLOOR_LIGHT is a square of
// depths in [0, 1].

#include "shadowtech/moment_map/exponential_warps.glsl"
#include "shadowtech/moment_map/moment_map.glsl"
#include "shadowtech/moment_map/chebyshev.glsl"

// Return the bound by one of the functions. All values are divided by the function's value at the
// receiver, so small ones keep their digits. If the mean far exceeds that value, the square may
// overflow; the variance has no effect then.
float warpedBound_LIGHT(vec2 moments, float warped, float exponent)
{
  float size = abs(warped);
  float mean = moments.x / size;
  float variance = moments.y / size / size - mean * mean;
  float least = 4.0 * VARIANCE_FLOOR_LIGHT * exponent * exponent;
  return chebyshevBound(mean, max(variance, least), sign(warped));
}

// Bounds how much nearer to the light a receiver must be compared. At that depth, the second
// function has its mean over the receiver's own plane (docs/theory/moment_maps.md).
float concaveBias_LIGHT(ViewPoint point)
{
  float exponent = 2.0 * exponentNegative; // for depths in [0, 1]
  vec2 halfSpan = 0.5 * (kernelTexels_LIGHT(point) + 1.0) * exponent * planeSlope_LIGHT(point);
  vec2 bias = min(halfSpan, halfSpan * halfSpan / 6.0) / exponent;
  return bias.x + bias.y;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  vec4 moments = momentsAt_LIGHT(point);
  float positive = exp(exponentPositive * centredDepth_LIGHT(point, slack));
  float negative =
    -exp(-exponentNegative * centredDepth_LIGHT(point, slack + concaveBias_LIGHT(point)));
  return withoutBleeding_LIGHT(min(warpedBound_LIGHT(moments.xy, positive, exponentPositive),
    warpedBound_LIGHT(moments.zw, negative, exponentNegative)));
}
