// The pixel to fetch, if a pixel has one sample.

ivec2 gnomonLayerPixel()
{
  return ivec2(gl_FragCoord.xy) - gnomonOrigin;
}
