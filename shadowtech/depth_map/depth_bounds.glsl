// Decides the texels around a point by a depth map's pyramid of bounds (DepthBounds.h).

#include "shadowtech/depth_map/depth_map.glsl"

uniform sampler2DArray depthBounds_LIGHT; // least and largest, blocks of 2, 4, 8, ... texels

// The texels between two places that lie on the map.
struct TexelWindow_LIGHT
{
  ivec2 first;
  ivec2 last;
  int level; // the level where 2 x 2 blocks of 2^level texels hold all
};

TexelWindow_LIGHT windowOf_LIGHT(vec2 lower, vec2 upper)
{
  vec2 end = vec2(viewSize_LIGHT - 1.0);
  TexelWindow_LIGHT window;
  window.first = ivec2(clamp(floor(lower), vec2(0.0), end));
  window.last = ivec2(clamp(floor(upper), vec2(0.0), end));
  int width = max(window.last.x - window.first.x, window.last.y - window.first.y) + 1;
  window.level = 1;
  while (1 << window.level < width)
  {
    ++window.level;
  }
  return window;
}

TexelWindow_LIGHT windowAround_LIGHT(ViewPoint point, vec2 reach)
{
  return windowOf_LIGHT(point.texel - reach, point.texel + reach);
}

// Return the least and the largest depth of blocks that hold all texels of a window, and more.
vec2 boundsOf_LIGHT(ViewPoint point, TexelWindow_LIGHT window)
{
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

float least_LIGHT(vec4 of)
{
  return min(min(of.x, of.y), min(of.z, of.w));
}
float largest_LIGHT(vec4 of)
{
  return max(max(of.x, of.y), max(of.z, of.w));
}

// Return the result that all texels of a window agree on: 1 lit, 0 hidden; -1 if the bounds of
// blocks of 2^level texels do not decide. Rounding between the corners of a block and its texels is
// well below half of the slack.
// @param own the least and the largest `own` of isLitBy_LIGHT()
float decided_LIGHT(ViewPoint point, TexelWindow_LIGHT window, int level, vec2 own, float slack)
{
  bool lit = true;
  bool hidden = true;
  for (int y = window.first.y >> level; y <= window.last.y >> level; ++y)
  {
    for (int x = window.first.x >> level; x <= window.last.x >> level; ++x)
    {
      vec2 bounds = texelFetch(depthBounds_LIGHT, ivec3(x, y, point.view), level - 1).rg;
      // On the map a plane's depth is monotonic along every line, so corners bound it.
      vec2 lower = vec2(max(ivec2(x, y) << level, window.first)) + 0.5;
      vec2 upper = vec2(min((ivec2(x, y) + 1) << level, window.last + 1)) - 0.5;
      vec4 plane = vec4(planeDistance_LIGHT(point, lower), planeDistance_LIGHT(point, upper),
        planeDistance_LIGHT(point, vec2(lower.x, upper.y)),
        planeDistance_LIGHT(point, vec2(upper.x, lower.y)));
      float nearest = viewDepth_LIGHT(point, min(least_LIGHT(plane), own.x));
      float farthest = viewDepth_LIGHT(point, min(largest_LIGHT(plane), own.y));
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

// Decide by the texels themselves.
float decidedByTexels_LIGHT(ViewPoint point, TexelWindow_LIGHT window, vec2 own, float slack)
{
  bool lit = true;
  bool hidden = true;
  for (int y = window.first.y; y <= window.last.y; ++y)
  {
    for (int x = window.first.x; x <= window.last.x; ++x)
    {
      float depth = depthAt_LIGHT(point.view, ivec2(x, y));
      float plane = planeDistance_LIGHT(point, vec2(x, y) + 0.5);
      float nearest = viewDepth_LIGHT(point, min(plane, own.x));
      float farthest = viewDepth_LIGHT(point, min(plane, own.y));
      lit = lit && (depth >= 1.0 || farthest <= depth + 0.5 * slack);
      hidden = hidden && depth < 1.0 && nearest > depth + 1.5 * slack;
      if (!lit && !hidden)
      {
        return -1.0;
      }
    }
  }
  return lit ? 1.0 : 0.0;
}

// Windows of up to this level are decided by single texels, at most 4 x 4. Most unshadowed points
// of a surface have windows of level one or two. There a block's least depth, that of its nearest
// texel, lies in front of the surface at the others and decides nothing.
const int levelOfTexels_LIGHT = 2;

// Decide by large blocks, then by smaller ones, then by texels.
float decided_LIGHT(ViewPoint point, TexelWindow_LIGHT window, vec2 own, float slack)
{
  float decided = decided_LIGHT(point, window, window.level, own, slack);
  int finer = max(window.level - 2, 1);
  if (decided < 0.0 && finer < window.level)
  {
    decided = decided_LIGHT(point, window, finer, own, slack);
  }
  if (decided < 0.0 && window.level <= levelOfTexels_LIGHT)
  {
    decided = decidedByTexels_LIGHT(point, window, own, slack);
  }
  return decided;
}

// Decide all texels within a reach, and those to which rounding may move a place.
float decided_LIGHT(ViewPoint point, vec2 reach, float slack)
{
  return decided_LIGHT(
    point, windowAround_LIGHT(point, reach + 0.01), point.position.zz, slack);
}
