// The image route's fetch of many lights' visibility: all at once, in a loop that no compiler
// unrolls, as it does not know its end. Software OpenGL makes machine code of every fetch anew,
// which takes ten times as long as all else of a program with twenty.

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
