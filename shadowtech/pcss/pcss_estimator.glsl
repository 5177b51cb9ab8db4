// Percentage closer soft shadows (Fernando 2005): a search for blockers, a penumbra's width, a filter of that
// width, all in separations (Pcss.h). The kernel of both steps is the light's shape, of radius or half side 1.

#include "shadowtech/depth_map/depth_bounds.glsl"
#include "shadowtech/depth_map/kernel.glsl"

uniform sampler2D lightPoints_LIGHT; // the search's, then the filter's
uniform mat3 viewFromUnitLight_LIGHT[VIEWS_LIGHT];

// How far beside its own ray a surface may be found that is taken to hide a point of the light all the same, as a
// share of that ray's way: surfaces slope.
const float leastShareOfSeparation_LIGHT = 0.75;

// The light as the point sees it: its shape on the plane across the view, through its centre. Of a directional
// light it is at distance 1.
mat2 lightAcross_LIGHT(ViewPoint point)
{
  mat3 light = viewFromUnitLight_LIGHT[point.view];
#if PCSS_BALL_LIGHT
  // A ball's outline seen along a slope is longer that way: by the ray's length to distance 1.
  vec2 slope = acrossOf_LIGHT(point.position);
  float ray = length(vec3(slope, 1.0));
  return length(light[0]) * (mat2(1.0) + outerProduct(slope, slope) / (1.0 + ray));
#elif VIEWS_CUBE_LIGHT
  // A flat light that stands at a slant is followed along the ray.
  vec2 slope = acrossOf_LIGHT(point.position);
  return mat2(light[0].xy - light[0].z * slope, light[1].xy - light[1].z * slope);
#else
  return mat2(light);
#endif
}

// How far a point of the shape is out, from 0 in its middle to 1 at its rim.
float extentOf_LIGHT(vec2 place)
{
#if PCSS_RECTANGLE_LIGHT
  return max(abs(place.x), abs(place.y));
#else
  return length(place);
#endif
}

// How far the whole shape reaches, at a separation of 1.
vec2 reachOf_LIGHT(mat2 texels)
{
#if PCSS_RECTANGLE_LIGHT
  return abs(texels[0]) + abs(texels[1]);
#else
  return vec2(length(vec2(texels[0].x, texels[1].x)), length(vec2(texels[0].y, texels[1].y)));
#endif
}

// The separation of what is at a depth of the map.
float separationOf_LIGHT(ViewPoint point, float depth)
{
  vec2 depths = viewDepths_LIGHT[point.view];
  float distanceLight = (depth - depths.y) / depths.x;
#if VIEWS_PERSPECTIVE_LIGHT
  // What touches the light is as good as what nearly does.
  float nearest = 1e-5 * point.position.z;
  return max(1.0 / max(distanceLight, nearest) - 1.0 / point.position.z, 0.0);
#else
  return max(point.position.z - distanceLight, 0.0);
#endif
}

// The separation of what hides the point at a place of the map; -1 where nothing does.
float separationAt_LIGHT(ViewPoint point, vec2 place, float slack)
{
  ivec2 texel = ivec2(clamp(floor(place), vec2(0.0), vec2(viewSize_LIGHT - 1.0)));
  if (isLitAt_LIGHT(point, texel, slack))
  {
    return -1.0;
  }
  float depth = texelFetch(depthMap_LIGHT, ivec3(texel, point.view), 0).r;
#if MAP_EUCLIDEAN_LIGHT
  depth /= rayScale_LIGHT[point.view] *
    length(vec3(acrossOf_LIGHT(point.view, vec2(texel) + 0.5), 1.0));
#endif
  return separationOf_LIGHT(point, depth);
}

// The largest separation that a caster has within the light's reach at that separation. What the first
// steps find lies farther around than what the last one needs.
float largestSeparation_LIGHT(ViewPoint point, vec2 reach)
{
  float separation = separationOf_LIGHT(point, boundsAround_LIGHT(point, vec2(viewSize_LIGHT)).x);
  for (int i = 0; i < 3; ++i)
  {
    float nearest = boundsAround_LIGHT(point, reach * separation).x;
    separation = min(separation, separationOf_LIGHT(point, nearest));
  }
  return separation;
}

#if PCSS_ASKS_BOUNDS_LIGHT
// What the filter answers at any separation up to the largest: 1 lit, 0 hidden, -1 where the map's
// bounds do not tell.
float filterDecided_LIGHT(ViewPoint point, vec2 reach, float largest, float slack)
{
  float decided = decided_LIGHT(point, reach * largest, slack);
  if (decided == 0.0)
  {
    float farthest = boundsAround_LIGHT(point, reach * largest).y;
    bool allHide = separationOf_LIGHT(point, farthest) > leastShareOfSeparation_LIGHT * largest;
    return allHide ? 0.0 : -1.0;
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
  ViewPoint point, mat2 texels, float separation, vec2 place, float slack)
{
  float extent = extentOf_LIGHT(place);
  float found = separationAt_LIGHT(point, point.texel + texels * (separation * place), slack);
  if (found < 0.0 || found >= separation * extent)
  {
    return found >= 0.0;
  }
  float again = separationAt_LIGHT(point, point.texel + texels * (found * place), slack);
  return again >= leastShareOfSeparation_LIGHT * found * extent;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 light = lightAcross_LIGHT(point);
  mat2 texels = texelJacobian_LIGHT(point.view, acrossOf_LIGHT(point.position)) * light;
  vec2 reach = reachOf_LIGHT(texels);
  float largest = largestSeparation_LIGHT(point, reach);
  // What rounding does to the receiver's plane grows with how far that is followed: half a texel so far.
  vec2 farthest = min(reach * largest, vec2(viewSize_LIGHT));
  slack *= max(2.0 * max(farthest.x, farthest.y), 1.0);
#if PCSS_ASKS_BOUNDS_LIGHT
  float decided = filterDecided_LIGHT(point, reach, largest, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
#if VIEWS_PERSPECTIVE_LIGHT
  float centre = -dot(point.normal, point.position);
#else
  float centre = -point.normal.z;
#endif
  vec3 facing = vec3(point.normal.xy * light, centre);
  vec2 pattern = patternOf_LIGHT(point);
  const float points = float(PCSS_SEARCH_POINTS_LIGHT);

  float own = separationAt_LIGHT(point, point.texel, slack);
  float blockers = own < 0.0 ? 0.0 : shareHidden_LIGHT(1.0 / (points * points), own, largest);
  float sum = blockers * own;
  for (int i = 0; i < PCSS_SEARCH_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(i, pattern, facing);
    place *= extentOf_LIGHT(place);
    float extent = extentOf_LIGHT(place);
    float separation = separationAt_LIGHT(point, point.texel + texels * (largest * place), slack);
    if (separation >= largest * extent)
    {
      float share = shareHidden_LIGHT(2.0 * extent / points, separation, largest);
      blockers += share;
      sum += share * separation;
    }
  }
  // A search that finds nothing is not believed: at a penumbra's rim the filter's points may find what it
  // missed.
  float mean = blockers > 0.0 ? min(sum / blockers, largest) : largest;
#if PCSS_ASKS_BOUNDS_LIGHT
  decided = filterDecided_LIGHT(point, reach, mean, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
  float hidden = 0.0;
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = lightPoint_LIGHT(PCSS_SEARCH_POINTS_LIGHT + i, pattern, facing);
    hidden += hidesLightPoint_LIGHT(point, texels, mean, place, slack) ? 1.0 : 0.0;
  }
  return max(1.0 - hidden / float(PCSS_FILTER_POINTS_LIGHT), 0.0);
}
