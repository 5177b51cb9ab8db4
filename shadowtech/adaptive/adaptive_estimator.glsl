// Percentage closer filtering over a jittered disc, which reads fewer points where the whole disc
// is lit or hidden (Adaptive.h). DISC_TEXELS_LIGHT is the disc's diameter. DISC_POINTS_LIGHT is the
// number of its points, of which the first DISC_RING_LIGHT lie on its rim.

#include "shadowtech/base/kernel_units.glsl"
#include "shadowtech/base/share.glsl"
#include "shadowtech/depth_map/kernel.glsl"
#if DISC_ASKS_BOUNDS_LIGHT
#include "shadowtech/depth_map/depth_bounds.glsl"
#endif

uniform sampler2DArray discs_LIGHT; // a layer for each point, a texel for each disc

// Return the sum of hidden shares over some of the disc's points.
float hiddenOf_LIGHT(ViewPoint point, mat2 shape, ivec2 disc, int first, int end, float slack)
{
  float hidden = 0.0;
  for (int i = first; i < end; ++i)
  {
    vec2 offset = shape * texelFetch(discs_LIGHT, ivec3(disc, i), 0).rg;
    hidden += hidden_LIGHT(point, ivec2(floor(point.texel + offset)), slack);
  }
  return hidden;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 shape = 0.5 * float(DISC_TEXELS_LIGHT) * kernelShape_LIGHT(point);
#if DISC_ASKS_BOUNDS_LIGHT
  vec2 reach = vec2(length(vec2(shape[0].x, shape[1].x)), length(vec2(shape[0].y, shape[1].y)));
  float decided = decided_LIGHT(point, reach, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
  ivec2 disc = ivec2(4.0 * point.texel) % DISC_SETS_LIGHT;
  float hidden = hiddenOf_LIGHT(point, shape, disc, 0, DISC_RING_LIGHT, slack);
#if DISC_ASKS_RING_LIGHT
  if (hidden == 0.0 || hidden == float(DISC_RING_LIGHT))
  {
    return hidden == 0.0 ? 1.0 : 0.0;
  }
#endif
  hidden += hiddenOf_LIGHT(point, shape, disc, DISC_RING_LIGHT, DISC_POINTS_LIGHT, slack);
  return 1.0 - shareOf(hidden, float(DISC_POINTS_LIGHT));
}
