// Percentage closer soft shadows (Fernando 2005): a search for blockers, a penumbra's width, a
// filter of that width, all in separations (Pcss.h). The kernel of both steps is the light's shape,
// of radius or half side 1.

#include "shadowtech/depth_map/depth_bounds.glsl"
#include "shadowtech/depth_map/kernel.glsl"
#include "shadowtech/pcss/light_shape.glsl"
#if VIEWS_CUBE_LIGHT
#include "shadowtech/pcss/light_around.glsl"
#else
#include "shadowtech/pcss/light_on_map.glsl"
#endif

uniform sampler2D lightPoints_LIGHT; // the search's, then the filter's

// How far beside its own ray a surface may be found that is taken to hide a point of the light all
// the same, as a share of that ray's way: surfaces slope.
const float leastShareOfSeparation_LIGHT = 0.75;

// Behind those of all maps, those of Pcss::info(), in their order.
#define PCSS_LIT_BY_BOUNDS 4
#define PCSS_HIDDEN_BY_BOUNDS 5
#define PCSS_NO_BLOCKER 6

#if PCSS_ASKS_BOUNDS_LIGHT
// What search and filter answer: 1 lit, 0 hidden, -1 where the map's bounds do not tell. Neither
// looks farther than the largest separation.
float decidedByBounds_LIGHT(ViewPoint point, SeenLight_LIGHT light, float largest, float slack)
{
  float decided = decidedWithin_LIGHT(point, light, largest, slack);
  if (decided == 0.0)
  {
    float least = leastSeparation_LIGHT(point, light, largest);
    return least > leastShareOfSeparation_LIGHT * largest ? 0.0 : -1.0;
  }
  return decided;
}
#endif

// How a cell of the map takes the points: a turn of the disk (its x axis), or a shift of the
// square.
vec2 patternOf_LIGHT(ViewPoint point)
{
  ivec2 cell = ivec2(4.0 * point.texel);
#if PCSS_RECTANGLE_LIGHT
  return vec2(noise_LIGHT(cell), noise_LIGHT(cell + 32768));
#else
  float angle = 6.2831853 * noise_LIGHT(cell);
  return vec2(cos(angle), sin(angle));
#endif
}

// A point of the light's shape, by its number and the cell's pattern.
// @param facing how the light's centre and its shape's axes face the receiver's plane
vec2 lightPoint_LIGHT(int number, vec2 pattern, vec3 facing)
{
  vec2 place = texelFetch(lightPoints_LIGHT, ivec2(number, 0), 0).rg;
#if PCSS_RECTANGLE_LIGHT
  place = 2.0 * fract(0.5 * place + 0.5 + pattern) - 1.0;
#else
  place = mat2(pattern, vec2(-pattern.y, pattern.x)) * place;
#endif
  return dot(facing, vec3(place, 1.0)) < 0.0 ? -place : place;
}

// What is found no nearer than this share of where it is looked for is there.
const float ownShareOfSeparation_LIGHT = 0.9;

// How often that is done at most. It is rarely more than once; most where casters reach far towards
// the light.
#define PCSS_LOOKS_AGAIN_LIGHT 4

// What hides points of the light, as a search finds it.
struct Blockers_LIGHT
{
  float area; // on the map; 0: there are none
  float sum;  // of separations over it
  float least;
};

void add_LIGHT(inout Blockers_LIGHT blockers, float separation, float area)
{
  blockers.area += area;
  blockers.sum += area * separation;
  blockers.least = min(blockers.least, separation);
}

// Searches as far as the largest separation for what hides any point of the light.
Blockers_LIGHT blockersOf_LIGHT(
  ViewPoint point, SeenLight_LIGHT light, vec2 pattern, float largest, float slack)
{
  Blockers_LIGHT blockers = Blockers_LIGHT(0.0, 0.0, largest);
  const float points = float(PCSS_SEARCH_POINTS_LIGHT);
  float own = separationAt_LIGHT(point, light, vec2(0.0), slack);
  if (own >= 0.0)
  {
    add_LIGHT(blockers, own, 1.0 / (points * points));
  }
  for (int i = 0; i < PCSS_SEARCH_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(i, pattern, light.facing);
    float part = spreadForSearch_LIGHT(place, light, point, largest) / points;
    float separation = separationAt_LIGHT(point, light, largest * place, slack);
    if (separation >= largest * extentOf_LIGHT(place))
    {
      add_LIGHT(blockers, separation, part);
    }
  }
  return blockers;
}

// The separation of what hides the receiver from a point of the light that is looked for at another
// one; -1: nothing. What is found at another separation hides another point, and so is looked for
// again at its own: the wall of a corner, a surface further down, or one nearer to the light.
// @param largest that any caster has
float hiderOf_LIGHT(ViewPoint point, SeenLight_LIGHT light, vec2 place, float separation,
  float largest, float slack)
{
  for (int look = 0; look <= PCSS_LOOKS_AGAIN_LIGHT; ++look)
  {
    float found = min(separationAt_LIGHT(point, light, separation * place, slack), largest);
    if (found < 0.0)
    {
      return -1.0;
    }
    bool again = look > 0;
    if (again && found >= ownShareOfSeparation_LIGHT * separation)
    {
      return separation;
    }
    if (!again && found >= separation && leastShareOfSeparation_LIGHT * found <= separation)
    {
      return found;
    }
    if (look == PCSS_LOOKS_AGAIN_LIGHT)
    {
      bool beside =
        found >= leastShareOfSeparation_LIGHT * separation * extentOf_LIGHT(place);
      return beside ? separation : -1.0;
    }
    separation = found;
  }
  return -1.0;
}

// Searches by the filter's points, each for what hides it: more, and none in vain.
Blockers_LIGHT blockersOfFilter_LIGHT(
  ViewPoint point, SeenLight_LIGHT light, vec2 pattern, float largest, float slack)
{
  Blockers_LIGHT blockers = Blockers_LIGHT(0.0, 0.0, largest);
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(PCSS_SEARCH_POINTS_LIGHT + i, pattern, light.facing);
    float separation = hiderOf_LIGHT(point, light, place, largest, largest, slack);
    if (separation >= 0.0)
    {
      add_LIGHT(blockers, separation, 1.0);
    }
  }
  return blockers;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  SeenLight_LIGHT light = seenLight_LIGHT(point);
  float largest = largestSeparation_LIGHT(point, light);
  // What rounding does to the receiver's plane grows with how far that is followed: half a texel so
  // far.
  slack *= max(2.0 * texelsAcross_LIGHT(point, light, largest), 1.0);
#if PCSS_ASKS_BOUNDS_LIGHT
  float decided = decidedByBounds_LIGHT(point, light, largest, slack);
  if (decided >= 0.0)
  {
    pixelClass_LIGHT = decided > 0.0 ? PCSS_LIT_BY_BOUNDS : PCSS_HIDDEN_BY_BOUNDS;
    return decided;
  }
#endif
  vec2 pattern = patternOf_LIGHT(point);
  Blockers_LIGHT blockers = blockersOf_LIGHT(point, light, pattern, largest, slack);
  if (blockers.area == 0.0)
  {
    // At a penumbra's rim few points may have missed what there is.
    blockers = blockersOfFilter_LIGHT(point, light, pattern, largest, slack);
  }
  if (blockers.area == 0.0)
  {
    pixelClass_LIGHT = PCSS_NO_BLOCKER;
    return 1.0;
  }
  // What is near the receiver hides the light along other ways than what is far above it; and what
  // is round by its rim, which is farther from the light than its middle.
  float least = blockers.least;
  float mean = clamp(blockers.sum / blockers.area, least, largest);
  bool several = least < leastShareOfSeparation_LIGHT * mean;
  float hidden = 0.0;
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(PCSS_SEARCH_POINTS_LIGHT + i, pattern, light.facing);
    bool hides = hiderOf_LIGHT(point, light, place, least, largest, slack) >= 0.0;
    // A loop, which software OpenGL leaves where it skips no branch.
    for (int other = 0; other < 1 && several && !hides; ++other)
    {
      hides = hiderOf_LIGHT(point, light, place, mean, largest, slack) >= 0.0;
    }
    hidden += hides ? 1.0 : 0.0;
  }
  return max(1.0 - hidden / float(PCSS_FILTER_POINTS_LIGHT), 0.0);
}
