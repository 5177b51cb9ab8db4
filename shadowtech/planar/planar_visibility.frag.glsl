// How many of a light's samples each pixel's receiver sees, by the shadows that were drawn on planes.
// What lies on none sees all that it faces. Up to 32 samples at a time; after the last of them, the
// share.

#include "shadowtech/base/light_reach.glsl"
#include "shadowtech/base/running_sum.glsl"

#define MOST_SAMPLES 32

uniform sampler2D receiverFragments; // zw: the normal's x and y
uniform sampler2D receiverPoints;    // xyz: position, w: the normal's z; all in view coordinates
uniform usampler2D planesOfPixels;   // planes_of_pixels.frag.glsl
uniform usampler2D shadows;          // a bit for each sample that is shadowed
uniform int sampleCount;
uniform vec4 samplesView[MOST_SAMPLES]; // (position, 1) or (towards the light, 0)
uniform int facingPlane[PLANES];        // the bits of the samples that the plane's visible side faces
uniform float divisor;                  // 1, or the number of all samples

out float visibility;

// The samples that a surface faces.
uint facedBy(vec3 positionView, vec3 normalView)
{
  uint bits = 0u;
  for (int i = 0; i < sampleCount; ++i)
  {
    vec3 toLight = samplesView[i].xyz - samplesView[i].w * positionView;
    bits |= facesLight(normalView, toLight) ? 1u << i : 0u;
  }
  return bits;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint plane = texelFetch(planesOfPixels, pixel, 0).r;
  int lit = sampleCount;
  if (plane > 0u)
  {
    vec4 point = texelFetch(receiverPoints, pixel, 0);
    vec3 normal = vec3(texelFetch(receiverFragments, pixel, 0).zw, point.w);
    uint facing = plane > 1u ? uint(facingPlane[plane - 2u]) : facedBy(point.xyz, normal);
    lit = lightReaches(point.xyz) ? bitCount(facing & ~texelFetch(shadows, pixel, 0).r) : 0;
  }
  visibility = (summedBefore(pixel).r + float(lit)) / divisor;
}
