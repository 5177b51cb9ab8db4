// The image route's fetch where a pixel has one sample.

float gnomonLayer(int layer)
{
  return texelFetch(gnomonLayers, ivec3(ivec2(gl_FragCoord.xy) - gnomonOrigin, layer), 0).r;
}
