// The image route's fetch of hard shadows whose edges are smooth (EdgeImage.h). One of the bits
// marks pixels at edges. The frame's constants come first.

uniform usampler2D gnomonEdgeImage;

uint gnomonEdges[gnomonEdgeTexels]; // visibility of two lights each

void gnomonFetchEdges()
{
  for (int i = 0; i < gnomonEdgeTexels; ++i)
  {
    gnomonEdges[i] = 0xffffffffu; // as the centre's
  }
  // llvmpipe runs both sides of a branch, and no turn of a loop without any.
  uint isEdge = gnomonFetchedBits[gnomonEdgeBit / 32] >> gnomonEdgeBit % 32 & 1u;
  for (int i = 0; i < int(isEdge) * gnomonEdgeTexels; ++i)
  {
    int place = int(texelFetch(gnomonEdgeImage, gnomonLayerPixel(), 0).r);
    gnomonEdges[i] = texelFetch(gnomonEdgeImage, ivec2((place & 0xffff) + i, place >> 16), 0).r;
  }
}

float gnomonSmoothBit(int bit)
{
  uint visibility = gnomonEdges[bit / 2] >> 16 * (bit % 2) & 0xffffu;
  return visibility == 0xffffu ? gnomonBit(bit) : float(visibility) / 65534.0;
}
