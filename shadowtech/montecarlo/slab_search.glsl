// Tests whether a ray meets a slab of the light's map. It goes from cell to cell of the pyramid
// (SlabBounds.h), after Curtis 2009, section 3.5, algorithm 2. A cell of a level is a square of
// 2^level texels.
//
// LINEAR_SEARCH instead takes steps of equal length, with bisection (section 3.3). It needs maps
// with one slab per texel.

uniform sampler2DArray slabs; // pages of all views, one after another (slabs.glsl)
uniform sampler2DArray slabBounds;
uniform int mapSide;  // in texels
uniform int topLevel; // its single cell covers the whole map

// Return the bounds of a texel's cell (slab_bounds.comp.glsl).
vec4 boundsOfCell(int view, ivec2 texel, int level)
{
  return texelFetch(slabBounds, ivec3(texel >> level, view), level);
}

// Return bounds of all texels from one to another, and possibly of a few around them.
vec4 boundsOfRegion(int view, ivec2 lower, ivec2 upper)
{
  ivec2 size = upper - lower + 1;
  int level = min(findMSB(2 * max(size.x, size.y) - 1), topLevel);
  vec4 a = boundsOfCell(view, lower, level);
  vec4 b = boundsOfCell(view, ivec2(upper.x, lower.y), level);
  vec4 c = boundsOfCell(view, ivec2(lower.x, upper.y), level);
  vec4 d = boundsOfCell(view, upper, level);
  return vec4(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)),
    max(max(a.z, b.z), max(c.z, d.z)), min(min(a.w, b.w), min(c.w, d.w)));
}

#ifdef LINEAR_SEARCH

#define STEPS 32
#define BISECTIONS 6

// The state of a point in its texel. In an empty texel it is BEFORE and BEHIND at once.
#define INSIDE 0
#define BEFORE 1
#define BEHIND 2
#define EMPTY 3

#ifdef EYE_LAYER
uniform mat4 clipFromView;

// True if the camera sees that a point is in empty space, before the surface in its pixel (Curtis
// 2009, section 3.4).
bool seenEmpty(int view, vec3 point)
{
  vec4 place = viewFromRay[view] * vec4(point, 1.0);
  vec3 position = place.xyz / place.w;
  vec4 clip = clipFromView * vec4(position, 1.0);
  if (clip.w <= 0.0 || any(greaterThanEqual(abs(clip.xy), vec2(clip.w))))
  {
    return false; // outside the picture
  }
  ivec2 pixel = ivec2((0.5 * clip.xy / clip.w + 0.5) * vec2(textureSize(receiverPoints, 0)));
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  if (fragment.x == 0.0)
  {
    return true; // the camera sees the background
  }
  vec4 seen = texelFetch(receiverPoints, pixel, 0);
  vec3 normal = vec3(fragment.zw, seen.w);
  float footprint = pixelSide.x + pixelSide.y * -seen.z;
  return dot(normal, position - seen.xyz) > -footprint;
}
#endif

int stateAt(int view, vec3 point)
{
  ivec2 texel = clamp(ivec2(floor(point.xy)), ivec2(0), ivec2(mapSide - 1));
  vec2 slab = texelFetch(slabs, ivec3(texel, view), 0).xy;
  bool before = point.z < slab.x;
  bool behind = point.z > -slab.y;
#ifdef EYE_LAYER
  if (!before && !behind && seenEmpty(view, point))
  {
    return BEFORE;
  }
#endif
  return before && behind ? EMPTY : before ? BEFORE : behind ? BEHIND : INSIDE;
}

// True if a line towards the light may have met a slab between two points.
bool mayMeet(int first, int second)
{
  return (second == BEFORE && first != BEFORE) || (first == BEHIND && second != BEHIND);
}

// True if a line meets a slab.
// @param begin at the receiver
// @param where it does, from 0 at `begin` to 1 at `end`
bool meetsSlabs(int view, vec3 begin, vec3 end, out float where)
{
  where = 0.0;
  int state = stateAt(view, begin);
  for (int i = 0; i < STEPS && state != INSIDE; ++i)
  {
    float t = float(i) / float(STEPS);
    float last = float(i + 1) / float(STEPS);
    int next = stateAt(view, mix(begin, end, last));
    if (mayMeet(state, next))
    {
      // If either half may hold the hit, bisection takes the one nearer to the receiver.
      for (int j = 0; j < BISECTIONS; ++j)
      {
        float middle = 0.5 * (t + last);
        int between = stateAt(view, mix(begin, end, middle));
        if (between == INSIDE)
        {
          where = middle;
          return true;
        }
        bool inFirst = mayMeet(state, between);
        last = inFirst ? middle : last;
        t = inFirst ? t : middle;
        state = inFirst ? state : between;
      }
    }
    state = next;
    where = last;
  }
  return state == INSIDE;
}

#else

// True if a slab of a texel overlaps this range of depths.
bool meetsSlab(int view, ivec2 texel, float least, float greatest)
{
  bool meets = false;
  for (int i = 0; i < PAGES; ++i)
  {
    vec4 page = texelFetch(slabs, ivec3(texel, view * PAGES + i), 0);
    meets = meets || (page.x <= greatest && least <= -page.y) ||
      (page.z <= greatest && least <= -page.w);
  }
  return meets;
}

int cellsVisited = 0; // by all searches of the invocation; tests read it

// True if the line from `begin` to `end`, in ray space and on the map, meets a slab.
// @param where it enters the texel of that slab, from 0 at `begin` to 1 at `end`
bool meetsSlabs(int view, vec3 begin, vec3 end, out float where)
{
  vec3 way = end - begin;
  bvec2 ahead = greaterThanEqual(way.xy, vec2(0.0));
  // Lines along a column or a row never leave it.
  vec2 inverse = vec2(way.x != 0.0 ? 1.0 / way.x : 1e30, way.y != 0.0 ? 1.0 / way.y : 1e30);
  ivec2 texel = clamp(ivec2(floor(begin.xy)), ivec2(0), ivec2(mapSide - 1));
  float longest = max(abs(way.x), abs(way.y));
  int level = clamp(int(ceil(log2(longest + 1.0))), 0, topLevel);
  float t = 0.0;
  where = 0.0;
  // Each step descends or leaves a cell, and each cell left was descended to. So no line takes
  // nearly this many steps.
  for (int i = 0; i < 64 + 8 * mapSide; ++i)
  {
    ++cellsVisited;
    int side = 1 << level;
    ivec2 cell = (texel >> level) << level;
    vec2 border = vec2(ahead.x ? cell.x + side : cell.x, ahead.y ? cell.y + side : cell.y);
    vec2 leaving = (border - begin.xy) * inverse;
    leaving = vec2(way.x != 0.0 ? leaving.x : 1e30, way.y != 0.0 ? leaving.y : 1e30);
    float exit = max(min(leaving.x, leaving.y), t);
    float here = begin.z + t * way.z;
    float there = begin.z + min(exit, 1.0) * way.z;
    float least = min(here, there);
    float greatest = max(here, there);
    vec4 bounds = boundsOfCell(view, cell, level);
    if (bounds.x <= greatest && least <= bounds.y)
    {
      if (level > 0)
      {
        --level;
        continue;
      }
      if (meetsSlab(view, texel, least, greatest))
      {
        where = t;
        return true;
      }
    }
    if (exit >= 1.0)
    {
      return false;
    }
    // The next texel's number does not come from a position, as rounding may move that across the
    // border.
    t = exit;
    ivec2 place = clamp(ivec2(floor(begin.xy + t * way.xy)), cell, cell + side - 1);
    bool leavesAlongX = leaving.x <= leaving.y;
    texel.x = leavesAlongX ? (ahead.x ? cell.x + side : cell.x - 1) : place.x;
    texel.y = leavesAlongX ? place.y : (ahead.y ? cell.y + side : cell.y - 1);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(mapSide))))
    {
      return false;
    }
    level = min(level + 1, topLevel);
  }
  return false;
}

#endif
