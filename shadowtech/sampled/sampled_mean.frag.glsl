// Writes the share of a light's points that each pixel's receiver sees, among points added so far.
// For lights with a texture it is one channel of their colour, relative to the unhidden light.

#include "shadowtech/base/share.glsl"

uniform sampler2D sum;
uniform float whole; // the sum where visibility is 1

out float visibility;

void main()
{
  // Points that count twice may exceed the mean of a colour over all points.
  visibility = shareOf(texelFetch(sum, ivec2(gl_FragCoord.xy), 0).r, whole);
}
