// The common part of techniques with a plain shadow map. Their estimators (map_visibility.glsl)
// compare a point with the texels that they choose.
//
// The map holds the caster at a texel's centre only. So the receiver's plane is followed to that
// centre before depths are compared. A surface then never shadows itself, however steep it is and
// however far the texel. Where another surface covers the centre, the nearer of the plane's depth
// and the point's own depth counts: the plane is right on convex surfaces, the point in concave
// corners (DepthMapTechnique.h).

#include "shadowtech/base/map_visibility.glsl"

uniform sampler2DArray depthMap_LIGHT; // linear depth in [0, 1], one layer per view
#if MAP_EUCLIDEAN_LIGHT
uniform float rayScale_LIGHT[VIEWS_LIGHT]; // 1 / the longest ray to distance 1 from the light
#endif

// Return the map's measure of a distance from the light, on the ray through a place of the map.
float depthOnRay_LIGHT(ViewPoint point, float distanceLight, vec2 texel)
{
  float depth = viewDepth_LIGHT(point, distanceLight);
#if MAP_EUCLIDEAN_LIGHT
  depth *= rayScale_LIGHT[point.view] * length(vec3(acrossOf_LIGHT(point.view, texel), 1.0));
#endif
  return depth;
}

// Return the map's depth of the caster at a texel's centre.
float depthAt_LIGHT(int view, ivec2 texel)
{
  return texelFetch(depthMap_LIGHT, ivec3(texel, view), 0).r;
}

// Return the linear depth of a map's depth, by any metric.
float linearDepth_LIGHT(int view, ivec2 texel, float depth)
{
#if MAP_EUCLIDEAN_LIGHT
  depth /= rayScale_LIGHT[view] * length(vec3(acrossOf_LIGHT(view, vec2(texel) + 0.5), 1.0));
#endif
  return depth;
}

// True if the caster at a texel's centre does not hide the point from the light.
// @param depthCaster the map's depth at the texel
// @param own the point's own distance from the light, used if its plane is farther
bool isLitBy_LIGHT(ViewPoint point, ivec2 texel, float depthCaster, float own, float slack)
{
  if (depthCaster >= 1.0)
  {
    return true; // no caster here; receivers that do not cast may lie beyond the map's depths
  }
  vec2 centre = vec2(texel) + 0.5;
  float nearer = min(planeDistance_LIGHT(point, centre), own);
  return depthOnRay_LIGHT(point, nearer, centre) <= depthCaster + slack;
}
bool isLitAt_LIGHT(ViewPoint point, ivec2 texel, float slack)
{
  return isLitBy_LIGHT(
    point, texel, depthAt_LIGHT(point.view, texel), point.position.z, slack);
}
