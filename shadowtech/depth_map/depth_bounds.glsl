// What a depth map's pyramid of bounds (DepthBounds.h) tells of the texels around a point.

#include "shadowtech/depth_map/depth_map.glsl"

uniform sampler2DArray depthBounds_LIGHT; // least and largest depth of blocks of 2, 4, 8, ... texels

// The texels around a point's place, as far as they lie on the map.
struct TexelWindow_LIGHT
{
  ivec2 first;
  ivec2 last;
  int level; // at which 2 x 2 blocks of 2^level texels hold all of them
};

TexelWindow_LIGHT windowAround_LIGHT(ViewPoint point, vec2 reach)
{
  vec2 end = vec2(viewSize_LIGHT - 1.0);
  TexelWindow_LIGHT window;
  window.first = ivec2(clamp(floor(point.texel - reach), vec2(0.0), end));
  window.last = ivec2(clamp(floor(point.texel + reach), vec2(0.0), end));
  int width = max(window.last.x - window.first.x, window.last.y - window.first.y) + 1;
  window.level = 1;
  while (1 << window.level < width)
  {
    ++window.level;
  }
  return window;
}

// The least and the largest depth in blocks that hold all texels within a reach, and more.
vec2 boundsAround_LIGHT(ViewPoint point, vec2 reach)
{
  TexelWindow_LIGHT window = windowAround_LIGHT(point, reach);
  vec2 bounds = vec2(1.0, 0.0);
  for (int y = window.first.y >> window.level; y <= window.last.y >> window.level; ++y)
  {
    for (int x = window.first.x >> window.level; x <= window.last.x >> window.level; ++x)
    {
      vec2 block = texelFetch(depthBounds_LIGHT, ivec3(x, y, point.view), window.level - 1).rg;
      bounds = vec2(min(bounds.x, block.x), max(bounds.y, block.y));
    }
  }
  return bounds;
}

// What all texels of a window say: 1 lit, 0 hidden, -1 where the bounds of blocks of 2^level texels do
// not tell. Rounding between the corners of a block and its texels is well below half of the slack.
float decided_LIGHT(ViewPoint point, TexelWindow_LIGHT window, int level, float slack)
{
  bool lit = true;
  bool hidden = true;
  for (int y = window.first.y >> level; y <= window.last.y >> level; ++y)
  {
    for (int x = window.first.x >> level; x <= window.last.x >> level; ++x)
    {
      vec2 bounds = texelFetch(depthBounds_LIGHT, ivec3(x, y, point.view), level - 1).rg;
      // On the map a plane's depth is monotonic along every line, so that its bounds are at corners.
      vec2 lower = vec2(max(ivec2(x, y) << level, window.first)) + 0.5;
      vec2 upper = vec2(min((ivec2(x, y) + 1) << level, window.last + 1)) - 0.5;
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

// The same of all texels within a reach: from large blocks, then from smaller ones.
float decided_LIGHT(ViewPoint point, vec2 reach, float slack)
{
  TexelWindow_LIGHT window = windowAround_LIGHT(point, reach);
  float decided = decided_LIGHT(point, window, window.level, slack);
  int finer = max(window.level - 2, 1);
  return decided >= 0.0 || finer == window.level ? decided
                                                 : decided_LIGHT(point, window, finer, slack);
}
