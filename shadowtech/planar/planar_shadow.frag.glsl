// The shadow of a caster on a plane: one bit, of the light's sample, in the pixels whose receiver
// lies on that plane. So no shadow reaches beyond its receiver, and none is compared with the
// receiver's depth.

#include "shadowtech/base/cutout.glsl"

uniform usampler2D planesOfPixels; // planes_of_pixels.frag.glsl
uniform int plane;                 // of the shadow, counted as there
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
