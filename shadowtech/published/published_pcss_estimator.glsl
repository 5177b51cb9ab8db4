// Percentage closer soft shadows exactly as in Apelles' listings 4.8 to 4.11 (PublishedPcss.h).
// Distances are from the light's centre; radii are shares of a map of the whole cone.

#include "shadowtech/base/share.glsl"
#include "shadowtech/depth_map/depth_map.glsl"

uniform sampler2D lightPoints_LIGHT; // the search's points, then the filter's
uniform float widthLight_LIGHT;

// Return the distance from the light of the caster at a place on the map; beyond everything if
// there is none.
float distanceAt_LIGHT(ViewPoint point, vec2 place)
{
  ivec2 texel = ivec2(clamp(floor(place), vec2(0.0), vec2(viewSize_LIGHT - 1.0)));
  float depth = depthAt_LIGHT(point.view, texel);
  if (depth >= 1.0)
  {
    return 3e38;
  }
  vec2 depths = viewDepths_LIGHT[point.view];
  float along = (linearDepth_LIGHT(point.view, texel, depth) - depths.y) / depths.x;
  return along * length(vec3(acrossOf_LIGHT(point.view, vec2(texel) + 0.5), 1.0));
}

// Return the listings' random number for a pixel.
float random_LIGHT(vec2 pixel)
{
  return fract(sin(dot(pixel, vec2(12.9898, 78.233))) * 43758.5453);
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  float receiver = length(point.position);
  float angle = 6.2831853 * random_LIGHT(gl_FragCoord.xy);
  mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  // Width of the whole cone's map, at distance 1 across the light.
  float map = 2.0 * sqrt(lightCone_LIGHT);
  mat2 texels = map * texelJacobian_LIGHT(point.view, acrossOf_LIGHT(point.position)) * turn;

  const float searchSide = sqrt(float(PCSS_SEARCH_POINTS_LIGHT));
  float blockers = 0.0;
  float sum = 0.0;
  for (int i = 0; i < PCSS_SEARCH_POINTS_LIGHT; ++i)
  {
    vec2 place = texelFetch(lightPoints_LIGHT, ivec2(i, 0), 0).rg;
    vec2 offset = texels * ((widthLight_LIGHT + widthLight_LIGHT / searchSide) * place);
    float caster = distanceAt_LIGHT(point, point.texel + offset);
    blockers += caster < receiver ? 1.0 : 0.0;
    sum += caster < receiver ? caster : 0.0;
  }
  if (blockers == 0.0)
  {
    return 1.0;
  }

  float blocker = max(sum / blockers, 1e-6 * receiver); // for blockers that touch the light
  float penumbra = (receiver - blocker) / blocker * widthLight_LIGHT;

  const float filterSide = sqrt(float(PCSS_FILTER_POINTS_LIGHT));
  float hidden = 0.0;
  for (int i = 0; i < PCSS_FILTER_POINTS_LIGHT; ++i)
  {
    vec2 place = texelFetch(lightPoints_LIGHT, ivec2(PCSS_SEARCH_POINTS_LIGHT + i, 0), 0).rg;
    vec2 offset = texels * ((penumbra + penumbra / filterSide) * place);
    hidden += distanceAt_LIGHT(point, point.texel + offset) < receiver ? 1.0 : 0.0;
  }
  return 1.0 - shareOf(hidden, float(PCSS_FILTER_POINTS_LIGHT));
}
