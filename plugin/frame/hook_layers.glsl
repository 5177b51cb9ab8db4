// The image route's fetch of many lights' visibility, in one loop. Its end is a uniform, so
// compilers cannot unroll it. llvmpipe compiles each fetch separately, which would be most of the
// first frame with twenty lights.

uniform int gnomonLayerCount;

float gnomonFetched[gnomonMostLayers];

void gnomonFetchLayers()
{
  ivec2 pixel = gnomonLayerPixel();
  for (int i = 0; i < gnomonLayerCount; ++i)
  {
    gnomonFetched[i] = texelFetch(gnomonLayers, ivec3(pixel, i), 0).r;
  }
}

float gnomonLayer(int layer)
{
  return gnomonFetched[layer];
}
