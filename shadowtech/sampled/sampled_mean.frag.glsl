// The share of a light's points that each pixel's receiver sees, of those that were added so far;
// of a light with a texture one channel of what they shine with, beside what is lit.

uniform sampler2D sum;
uniform float whole; // the sum where v is 1

out float visibility;

void main()
{
  // Points that count twice may have more of a colour than all of them have on the mean.
  visibility = min(texelFetch(sum, ivec2(gl_FragCoord.xy), 0).r / whole, 1.0);
}
