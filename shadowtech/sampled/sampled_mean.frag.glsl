// The share of a light's points that each pixel's receiver sees, of those that were added so far.

uniform sampler2D sum;
uniform float points;

out float visibility;

void main()
{
  visibility = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).r / points;
}
