// Draws the midpoint map (Woo 1992): halfway between the first and the second surface. Where there
// is no second one, the map stays as it is.

uniform sampler2DArray frontDepths;
uniform sampler2DArray backDepths;
uniform int layer;

void main()
{
  ivec3 texel = ivec3(gl_FragCoord.xy, layer);
  float back = texelFetch(backDepths, texel, 0).r;
  if (back >= 1.0)
  {
    discard;
  }
  gl_FragDepth = 0.5 * (texelFetch(frontDepths, texel, 0).r + back);
}
