// The plain shadow map's estimator: one comparison at the nearest texel (Williams 1978), made where
// the texel was sampled.
//
// The map knows the caster at the texel's centre only. So the receiver's plane is followed to that
// centre before depths are compared: a surface then never shadows itself, however steep, and no bias
// is needed for it. Where another surface covers the centre, the nearer of the plane's depth and the
// point's own depth counts: the plane is right on convex surfaces, the point in concave corners.

#include "shadowtech/base/light_views.glsl"

uniform sampler2DArray nsmMap_LIGHT; // linear depth in [0, 1], one layer per view
uniform float nsmSlack_LIGHT;        // what rounding does to a depth

float visibility_LIGHT(vec3 positionView, vec3 normalView)
{
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  if (!lightReaches_LIGHT(p, n))
  {
    return 0.0;
  }
  ViewPoint point;
  if (!findView_LIGHT(p, n, point))
  {
    return 1.0;
  }
  float depthCaster = texelFetch(nsmMap_LIGHT, ivec3(ivec2(point.texel), point.view), 0).r;
  if (depthCaster >= 1.0)
  {
    return 1.0; // no caster here; receivers that do not cast may lie beyond the map's depths
  }
  float depthReceiver =
    viewDepth_LIGHT(point, planeDistance_LIGHT(point, floor(point.texel) + 0.5));
  // The position is rounded relative to its distance from the camera, which the sum of its parts is
  // never less than: eight roundings of a float.
  float distanceView = dot(abs(positionView), vec3(1.0));
  float slack = nsmSlack_LIGHT + viewDepths_LIGHT[point.view].x * distanceView / 2097152.0;
  return depthReceiver <= depthCaster + slack ? 1.0 : 0.0;
}
