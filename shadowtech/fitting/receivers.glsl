// The camera's receivers, as the receivers stage draws them (ReceiverTarget.h).

#include "shadowtech/base/light_views.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates

const float infinity = uintBitsToFloat(0x7f800000u);

// Written so that NaN fails.
bool isFinite(vec3 v)
{
  return all(lessThan(abs(v), vec3(infinity)));
}

vec3 lightFromView(vec3 positionView)
{
  return (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
}

// True if the light reaches a pixel's receiver. False for background, surfaces that show no
// shadows, and numbers that are not finite.
bool isReached(ivec2 pixel, vec4 point)
{
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  vec3 normal = vec3(fragment.zw, point.w);
  return fragment.x > 0.0 && isFinite(point.xyz) && isFinite(normal) &&
    lightReaches_LIGHT(lightFromView(point.xyz), mat3(lightFromView_LIGHT) * normal);
}
