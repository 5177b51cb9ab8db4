// The plain shadow map's estimator: one comparison at the nearest texel (Williams 1978), made where
// the texel was sampled.
//
// The map knows the caster at the texel's centre only. So the receiver's plane is followed to that
// centre before depths are compared: a surface then never shadows itself, however steep, and no bias
// is needed for it. Where another surface covers the centre, the nearer of the plane's depth and the
// point's own depth counts: the plane is right on convex surfaces, the point in concave corners.

#include "shadowtech/base/shadow_ray.glsl"

uniform sampler2D nsmMap_LIGHT;         // linear depth in [0, 1]
uniform mat4 nsmLightFromView_LIGHT;    // rigid; z runs along the light
uniform vec4 nsmTexels_LIGHT;           // texel = xy * (x, y or their slopes) + zw
uniform vec4 nsmDepth_LIGHT;            // depth = x * z + y; z: rounding slack; w: map size in texels
#if NSM_SPOT_LIGHT
uniform float nsmCone_LIGHT; // squared tangent of half the cone
#endif

float visibility_LIGHT(vec3 positionView, vec3 normalView)
{
  vec3 p = (nsmLightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(nsmLightFromView_LIGHT) * normalView;

  const vec3 againstLight = vec3(0.0, 0.0, -1.0);
#if NSM_SPOT_LIGHT
  if (!facesLight(n, -p) || !insideCone(-p, againstLight, nsmCone_LIGHT))
  {
    return 0.0;
  }
  vec2 across = p.xy / p.z;
#else
  if (!facesLight(n, againstLight))
  {
    return 0.0;
  }
  vec2 across = p.xy;
#endif
  vec2 texel = nsmTexels_LIGHT.xy * across + nsmTexels_LIGHT.zw;
  if (any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(nsmDepth_LIGHT.w))))
  {
    return 1.0; // the map holds all casters: nothing can shadow what lies outside it
  }

  // The receiver's plane on the ray through the texel's centre.
  vec2 centre = (floor(texel) + 0.5 - nsmTexels_LIGHT.zw) / nsmTexels_LIGHT.xy;
#if NSM_SPOT_LIGHT
  // Where the plane runs past that ray or away from it, only the point's own depth is left.
  float along = dot(n, vec3(centre, 1.0));
  float z = along < 0.0 ? min(dot(n, p) / along, p.z) : p.z;
#else
  float z = min(p.z - dot(n.xy, centre - p.xy) / n.z, p.z);
#endif

  float depthReceiver = nsmDepth_LIGHT.x * z + nsmDepth_LIGHT.y;
  float depthCaster = texelFetch(nsmMap_LIGHT, ivec2(texel), 0).r;
  if (depthCaster >= 1.0)
  {
    return 1.0; // no caster here; receivers that do not cast may lie beyond the map's depths
  }
  // The position is rounded relative to its distance from the camera, which the sum of its parts is
  // never less than: eight roundings of a float.
  float distanceView = dot(abs(positionView), vec3(1.0));
  float slack = nsmDepth_LIGHT.z + nsmDepth_LIGHT.x * distanceView / 2097152.0;
  return depthReceiver <= depthCaster + slack ? 1.0 : 0.0;
}
