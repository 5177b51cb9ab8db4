// Counts the samples of a light that each pixel's receiver sees, by the shadows on planes.
// Receivers on no plane see the whole light if they face its centre. Up to 32 samples are counted
// at a time. The last pass writes the share of all.

#include "shadowtech/base/light_reach.glsl"
#include "shadowtech/base/running_sum.glsl"
#include "shadowtech/base/share.glsl"

uniform sampler2D receiverFragments; // zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
// 0: receives no shadow; 1: on none of the planes; n + 2: on the n-th.
uniform usampler2D planesOfPixels;
uniform usampler2D shadows; // a bit for each sample in shadow
uniform int sampleCount;
uniform vec4 lightView;                // of the centre: (position, 1) or (towards the light, 0)
uniform int planesFacingLight[PLANES]; // 1 if the plane's visible side faces the light's centre
uniform int sampleCountOfAll;          // in the last pass, else 0

out float visibility;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint plane = texelFetch(planesOfPixels, pixel, 0).r;
  int lit = sampleCount;
  if (plane > 0u)
  {
    vec4 point = texelFetch(receiverPoints, pixel, 0);
    vec3 normal = vec3(texelFetch(receiverFragments, pixel, 0).zw, point.w);
    bool faces = plane > 1u ? planesFacingLight[plane - 2u] == 1
                            : facesLight(normal, lightView.xyz - lightView.w * point.xyz);
    lit = faces && lightReaches(point.xyz)
      ? sampleCount - bitCount(texelFetch(shadows, pixel, 0).r)
      : 0;
  }
  float sum = summedBefore(pixel).r + float(lit);
  visibility = sampleCountOfAll > 0 ? shareOf(sum, float(sampleCountOfAll)) : sum;
}
