// The image route's fetch of a light's visibility.

float gnomonLayer(int layer)
{
  return texelFetch(gnomonLayers, ivec3(gnomonLayerPixel(), layer), 0).r;
}
