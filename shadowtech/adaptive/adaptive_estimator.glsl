// Percentage closer filtering over a jittered disc, which reads less of it where all of it is lit or
// hidden (Adaptive.h). DISC_TEXELS_LIGHT is the disc's diameter, DISC_POINTS_LIGHT are its points, the
// first DISC_RING_LIGHT of which lie on its rim.

#include "shadowtech/depth_map/kernel.glsl"

uniform sampler2DArray discs_LIGHT; // a layer for each point, a texel for each disc
#if DISC_ASKS_BOUNDS_LIGHT
uniform sampler2DArray depthBounds_LIGHT; // least and largest depth of blocks of 2, 4, 8, ... texels
#endif

// The share of some of the disc's points that is hidden, times their number.
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

#if DISC_ASKS_BOUNDS_LIGHT

// What all texels from first to last say: 1 lit, 0 hidden, -1 where the bounds of blocks of
// 2^level texels do not tell. Rounding between the corners of a block and its texels is well below half
// of the slack.
float decided_LIGHT(ViewPoint point, ivec2 first, ivec2 last, int level, float slack)
{
  bool lit = true;
  bool hidden = true;
  for (int y = first.y >> level; y <= last.y >> level; ++y)
  {
    for (int x = first.x >> level; x <= last.x >> level; ++x)
    {
      vec2 bounds = texelFetch(depthBounds_LIGHT, ivec3(x, y, point.view), level - 1).rg;
      // On the map a plane's depth is monotonic along every line, so that its bounds are at corners.
      vec2 lower = vec2(max(ivec2(x, y) << level, first)) + 0.5;
      vec2 upper = vec2(min((ivec2(x, y) + 1) << level, last + 1)) - 0.5;
      vec4 plane = vec4(planeDepth_LIGHT(point, lower), planeDepth_LIGHT(point, upper),
        planeDepth_LIGHT(point, vec2(lower.x, upper.y)),
        planeDepth_LIGHT(point, vec2(upper.x, lower.y)));
      float nearest = min(min(plane.x, plane.y), min(plane.z, plane.w));
      float farthest = max(max(plane.x, plane.y), max(plane.z, plane.w));
      lit = lit && (bounds.x >= 1.0 || farthest <= bounds.x + 0.5 * slack);
      hidden = hidden && bounds.y < 1.0 && nearest > bounds.y + 1.5 * slack;
      if (!lit && !hidden)
      {
        return -1.0;
      }
    }
  }
  return lit ? 1.0 : 0.0;
}

// The same of all texels that the disc can touch.
float decided_LIGHT(ViewPoint point, mat2 shape, float slack)
{
  vec2 reach =
    vec2(length(vec2(shape[0].x, shape[1].x)), length(vec2(shape[0].y, shape[1].y)));
  ivec2 end = ivec2(int(viewSize_LIGHT) - 1);
  ivec2 first = clamp(ivec2(floor(point.texel - reach)), ivec2(0), end);
  ivec2 last = clamp(ivec2(floor(point.texel + reach)), ivec2(0), end);
  int width = max(last.x - first.x, last.y - first.y) + 1;
  int level = 1;
  while (1 << level < width)
  {
    ++level;
  }
  float decided = decided_LIGHT(point, first, last, level, slack);
  int finer = max(level - 2, 1);
  return decided >= 0.0 || finer == level ? decided
                                          : decided_LIGHT(point, first, last, finer, slack);
}

#endif

float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 shape = 0.5 * float(DISC_TEXELS_LIGHT) * kernelShape_LIGHT(point);
#if DISC_ASKS_BOUNDS_LIGHT
  float decided = decided_LIGHT(point, shape, slack);
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
  return max(1.0 - hidden / float(DISC_POINTS_LIGHT), 0.0);
}
