// Percentage closer soft shadows (Fernando 2005): a blocker search, the penumbra's width, and a
// filter of that width, all in separations (Pcss.h). The kernel of both steps is the light's shape,
// of radius or half side 1.

#include "shadowtech/base/share.glsl"
#include "shadowtech/depth_map/depth_bounds.glsl"
#include "shadowtech/depth_map/kernel.glsl"
#include "shadowtech/pcss/light_shape.glsl"
#if VIEWS_CUBE_LIGHT
#include "shadowtech/pcss/light_around.glsl"
#else
#include "shadowtech/pcss/light_on_map.glsl"
#endif

uniform sampler2D lightPoints_LIGHT; // the search's points, then the filter's

// Surfaces slope. So a surface beside a point's own ray still hides the point if its separation is
// at least this share of the lookup's.
const float leastShareOfSeparation_LIGHT = 0.75;

// Follow the classes of all maps, in the order of Pcss::info().
#define PCSS_LIT_BY_BOUNDS 4
#define PCSS_HIDDEN_BY_BOUNDS 5
#define PCSS_NO_BLOCKER 6

#if PCSS_ASKS_BOUNDS_LIGHT
// Decide search and filter by the map's bounds: 1 lit, 0 hidden, -1 undecided. Neither looks beyond
// the largest separation.
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

// Return a cell's pattern of points: the x axis of a rotated disk, or a shift of the square.
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

// Return a point of the light's shape by its number and the cell's pattern.
// @param facing how far the shape's axes and centre are in front of the receiver's plane
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

// A caster is where it was looked up if its separation is at least this share of the lookup's.
const float ownShareOfSeparation_LIGHT = 0.9;

// Limit of repeated lookups. Most points need at most one; casters that reach far towards the light
// need most.
#define PCSS_LOOKS_AGAIN_LIGHT 4

// Blockers that a search finds.
struct Blockers_LIGHT
{
  float area; // on the map; 0 if there are none
  float sum;  // of separations over that area
  float least;
};

void add_LIGHT(inout Blockers_LIGHT blockers, float separation, float area)
{
  blockers.area += area;
  blockers.sum += area * separation;
  blockers.least = min(blockers.least, separation);
}

// Search up to the largest separation for casters that hide any point of the light.
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

// Return the separation of the caster that hides a point of the light from the receiver; -1 if none
// does. A caster found at another separation hides another point, so the point is looked up again
// at that separation. Examples are the wall of a corner, or a surface farther down or nearer to the
// light.
// @param separation of the first lookup
// @param largest separation of any caster
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

// Search with the filter's points for the casters that hide each. There are more of them, and none
// is tested in vain.
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
  // Rounding of the receiver's plane grows with the distance at which it is evaluated. The slack
  // allows for half a texel.
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
    // Few points may have missed the blockers at a penumbra's rim.
    blockers = blockersOfFilter_LIGHT(point, light, pattern, largest, slack);
  }
  if (blockers.area == 0.0)
  {
    pixelClass_LIGHT = PCSS_NO_BLOCKER;
    return 1.0;
  }
  // Casters near the receiver hide the light along other ways than casters far above it. The same
  // holds for rims of round casters, which are farther from the light than their middle.
  float least = blockers.least;
  float mean = clamp(blockers.sum / blockers.area, least, largest);
  bool several = least < leastShareOfSeparation_LIGHT * mean;
  float hidden = 0.0;
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(PCSS_SEARCH_POINTS_LIGHT + i, pattern, light.facing);
    bool hides = hiderOf_LIGHT(point, light, place, least, largest, slack) >= 0.0;
    // Software OpenGL runs both sides of a branch, but leaves a loop.
    for (int other = 0; other < 1 && several && !hides; ++other)
    {
      hides = hiderOf_LIGHT(point, light, place, mean, largest, slack) >= 0.0;
    }
    hidden += hides ? 1.0 : 0.0;
  }
  return 1.0 - shareOf(hidden, float(PCSS_FILTER_POINTS_LIGHT));
}
