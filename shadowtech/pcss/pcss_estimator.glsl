// Percentage closer soft shadows (Fernando 2005): a search for blockers, a penumbra's width, a filter of that
// width, all in separations (Pcss.h). The kernel of both steps is the light's shape, of radius or half side 1.

#include "shadowtech/depth_map/depth_bounds.glsl"
#include "shadowtech/depth_map/kernel.glsl"
#include "shadowtech/pcss/light_shape.glsl"
#if VIEWS_CUBE_LIGHT
#include "shadowtech/pcss/light_around.glsl"
#else
#include "shadowtech/pcss/light_on_map.glsl"
#endif

uniform sampler2D lightPoints_LIGHT; // the search's, then the filter's

// How far beside its own ray a surface may be found that is taken to hide a point of the light all the same, as a
// share of that ray's way: surfaces slope.
const float leastShareOfSeparation_LIGHT = 0.75;

#if PCSS_ASKS_BOUNDS_LIGHT
// What the filter answers at any separation up to the largest: 1 lit, 0 hidden, -1 where the map's
// bounds do not tell.
float filterDecided_LIGHT(ViewPoint point, SeenLight_LIGHT light, float largest, float slack)
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

// How a cell of the map takes the points: a turn of the disk (its x axis), or a shift of the square.
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

// The share of the light that is hidden by what has this separation on a part of the search's area. What
// lies near the point hides more of the light than what is as large on the map and near the light.
float shareHidden_LIGHT(float part, float separation, float largest)
{
  float larger = largest / max(separation, 1e-30); // 0 is left of what nearly touches the point
  return min(part * larger * larger, 1.0);
}

// Whether what is on the map where a point of the light is looked for hides the receiver from it. If that
// lies too near the receiver to do so, as the wall of a corner or a surface further down, it is looked for
// once more, at that surface's own separation.
bool hidesLightPoint_LIGHT(
  ViewPoint point, SeenLight_LIGHT light, float separation, vec2 place, float slack)
{
  float extent = extentOf_LIGHT(place);
  float found = separationAt_LIGHT(point, light, separation * place, slack);
  if (found < 0.0 || found >= separation * extent)
  {
    return found >= 0.0;
  }
  float again = separationAt_LIGHT(point, light, found * place, slack);
  return again >= leastShareOfSeparation_LIGHT * found * extent;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  SeenLight_LIGHT light = seenLight_LIGHT(point);
  float largest = largestSeparation_LIGHT(point, light);
  // What rounding does to the receiver's plane grows with how far that is followed: half a texel so far.
  slack *= max(2.0 * texelsAcross_LIGHT(point, light, largest), 1.0);
#if PCSS_ASKS_BOUNDS_LIGHT
  float decided = filterDecided_LIGHT(point, light, largest, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
  vec2 pattern = patternOf_LIGHT(point);
  const float points = float(PCSS_SEARCH_POINTS_LIGHT);

  float own = separationAt_LIGHT(point, light, vec2(0.0), slack);
  float blockers = own < 0.0 ? 0.0 : shareHidden_LIGHT(1.0 / (points * points), own, largest);
  float sum = blockers * own;
  for (int i = 0; i < PCSS_SEARCH_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(i, pattern, light.facing);
    float part = spreadForSearch_LIGHT(place, light, point, largest) / points;
    float separation = separationAt_LIGHT(point, light, largest * place, slack);
    if (separation >= largest * extentOf_LIGHT(place))
    {
      float share = shareHidden_LIGHT(part, separation, largest);
      blockers += share;
      sum += share * separation;
    }
  }
  // A search that finds nothing is not believed: at a penumbra's rim the filter's points may find what it
  // missed.
  float mean = blockers > 0.0 ? min(sum / blockers, largest) : largest;
#if PCSS_ASKS_BOUNDS_LIGHT
  decided = filterDecided_LIGHT(point, light, mean, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
  float hidden = 0.0;
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(PCSS_SEARCH_POINTS_LIGHT + i, pattern, light.facing);
    hidden += hidesLightPoint_LIGHT(point, light, mean, place, slack) ? 1.0 : 0.0;
  }
  return max(1.0 - hidden / float(PCSS_FILTER_POINTS_LIGHT), 0.0);
}
