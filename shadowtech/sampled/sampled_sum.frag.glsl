// Adds a batch to the sum of a light's points that each pixel's receiver sees. The sources of the
// batch come first, and before them the source of the light's centre, which defines the light's
// reach.

#include "shadowtech/base/running_sum.glsl"
#include "shadowtech/base/shine.glsl"

uniform sampler2D receiverFragments; // x: > 0 if it receives; zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform Shine batchShine;            // sum over all points of the batch

out Shine sum;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  sum = Shine(summedBefore(pixel));
  vec4 fragment = texelFetch(receiverFragments, pixel, 0);
  if (fragment.x <= 0.0)
  {
    sum += batchShine;
    return;
  }
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  vec3 normalView = vec3(fragment.zw, point.w);
  vec3 p = (lightFromView_LIGHT * vec4(point.xyz, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  if (lightReaches_LIGHT(p, n))
  {
#if VIEWS_PERSPECTIVE_LIGHT
    vec3 toCentre = -p;
#else
    vec3 toCentre = vec3(0.0, 0.0, -1.0);
#endif
    sum += sharesOfBatch(point.xyz, normalView, n, toCentre);
  }
}
