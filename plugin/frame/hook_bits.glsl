// The image route's fetch of hard shadows: a bit for each light, 1 where it arrives. Fetching a
// layer for each of eight lights takes llvmpipe as long as drawing the picture.

uniform usampler2D gnomonBits;

uvec2 gnomonFetchedBits; // 32 lights each

void gnomonFetchBits()
{
  gnomonFetchedBits = texelFetch(gnomonBits, gnomonLayerPixel(), 0).rg;
}

float gnomonBit(int bit)
{
  return float(gnomonFetchedBits[bit / 32] >> bit % 32 & 1u);
}
