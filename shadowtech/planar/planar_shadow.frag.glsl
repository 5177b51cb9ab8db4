// Writes a caster's shadow on a plane: the bit of the light's sample, in pixels whose receiver lies
// on that plane. So no shadow extends beyond its receiver, and no depths are compared.

#include "shadowtech/base/cutout.glsl"

uniform usampler2D planesOfPixels; // 0: no receiver; 1: on none of the planes; n + 2: on the n-th
uniform int plane;                 // the shadow's plane, as planesOfPixels counts
uniform int sampleBit;

out uint shadowed;

void main()
{
  bool elsewhere = texelFetch(planesOfPixels, ivec2(gl_FragCoord.xy), 0).r != uint(plane);
  shadowed = 1u << sampleBit;
  discardHoles();
  if (elsewhere)
  {
    discard;
  }
}
