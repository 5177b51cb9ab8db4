// The image route's fetch of hard shadows: one bit per light, 1 if its light arrives. On llvmpipe,
// fetching eight lights' layers takes as long as drawing the picture.

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
