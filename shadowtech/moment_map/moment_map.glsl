// Techniques with a map of moments: the mean moments around a point, and what their estimators do
// with a bound on the share of the map's depths that lie behind the point (MomentMapTechnique.h).
//
// KERNEL_TEXELS_LIGHT is the kernel's width; MOMENTS_SUMMED_LIGHT: the map is a summed-area table,
// else it was blurred. BLEEDING_LIGHT is the bound up to which a point is in full shadow.

#include "shadowtech/base/map_visibility.glsl"

// Both define the mean moments around a point, vec4 momentsAt_LIGHT(ViewPoint), and over how wide a
// kernel along the map's axes those are, vec2 kernelTexels_LIGHT(ViewPoint).
#if MOMENTS_SUMMED_LIGHT
#include "shadowtech/moment_map/moments_summed.glsl"
#else
#include "shadowtech/moment_map/moments_blurred.glsl"
#endif

// The receiver's depth, nearer by its rounding and by a bias in depths of [0, 1], from [0, 1] to
// [-1, 1] as that of the moments. Receivers that do not cast may lie behind all depths of the map:
// as far away as empty texels.
float centredDepth_LIGHT(ViewPoint point, float bias)
{
  return 2.0 * clamp(viewDepth_LIGHT(point, point.position.z) - bias, 0.0, 1.0) - 1.0;
}

// By how much the depth of the receiver's plane changes from texel to texel along both axes.
vec2 planeSlope_LIGHT(ViewPoint point)
{
  vec2 x = vec2(0.5, 0.0);
  vec2 y = vec2(0.0, 0.5);
  vec2 nearest = vec2(min(planeDistance_LIGHT(point, point.texel - x),
                        planeDistance_LIGHT(point, point.texel + x)),
    min(planeDistance_LIGHT(point, point.texel - y), planeDistance_LIGHT(point, point.texel + y)));
  return 2.0 * viewDepths_LIGHT[point.view].x * max(point.position.z - nearest, 0.0);
}

// The bound as a visibility: what bleeds through is cut off, and the rest spread over [0, 1].
float withoutBleeding_LIGHT(float bound)
{
  return clamp((bound - BLEEDING_LIGHT) / (1.0 - BLEEDING_LIGHT), 0.0, 1.0);
}
