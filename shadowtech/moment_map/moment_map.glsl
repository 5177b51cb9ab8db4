// The common part of techniques with a map of moments: the mean moments around a point, and how to
// use a bound. It bounds the share of the map's depths behind the point (MomentMapTechnique.h).
//
// KERNEL_TEXELS_LIGHT is the kernel's width. MOMENTS_SUMMED_LIGHT: the map is a summed-area table,
// else it is blurred. BLEEDING_LIGHT is the bound up to which a point is in full shadow.

#include "shadowtech/base/map_visibility.glsl"

// Both define vec4 momentsAt_LIGHT(ViewPoint), the mean moments around a point. They also define
// vec2 kernelTexels_LIGHT(ViewPoint), the width of their kernel along the map's axes.
#if MOMENTS_SUMMED_LIGHT
#include "shadowtech/moment_map/moments_summed.glsl"
#else
#include "shadowtech/moment_map/moments_blurred.glsl"
#endif

// Return the receiver's depth in [-1, 1], as of moments, nearer by its rounding and a bias in
// depths of [0, 1]. Receivers that do not cast may lie behind all depths of the map. They count as
// far as empty texels.
float centredDepth_LIGHT(ViewPoint point, float bias)
{
  return 2.0 * clamp(viewDepth_LIGHT(point, point.position.z) - bias, 0.0, 1.0) - 1.0;
}

// Return the change of depth per texel on the receiver's plane, along both axes.
vec2 planeSlope_LIGHT(ViewPoint point)
{
  vec2 x = vec2(0.5, 0.0);
  vec2 y = vec2(0.0, 0.5);
  vec2 nearest = vec2(min(planeDistance_LIGHT(point, point.texel - x),
                        planeDistance_LIGHT(point, point.texel + x)),
    min(planeDistance_LIGHT(point, point.texel - y), planeDistance_LIGHT(point, point.texel + y)));
  return 2.0 * viewDepths_LIGHT[point.view].x * max(point.position.z - nearest, 0.0);
}

// Return the bound as a visibility: a share up to the setting counts as shadow, and the rest is
// rescaled to [0, 1].
float withoutBleeding_LIGHT(float bound)
{
  return clamp((bound - BLEEDING_LIGHT) / (1.0 - BLEEDING_LIGHT), 0.0, 1.0);
}
