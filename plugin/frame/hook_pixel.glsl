// Which pixel's visibility is fetched, where a pixel has one sample.

ivec2 gnomonLayerPixel()
{
  return ivec2(gl_FragCoord.xy) - gnomonOrigin;
}
