// The pixel to fetch, if a pixel has several samples. The layers hold visibility at the pixels'
// centres. A surface that covers other samples of a pixel may be visible at the centre of a
// neighbour. So fetch from the pixel whose surface is nearest to the fragment's plane.

uniform sampler2D gnomonDepths; // the receivers stage's depth buffer

const ivec2 gnomonAround[5] =
  ivec2[5](ivec2(0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));

ivec2 gnomonPixel;

// Find the pixel. Depth is affine over the picture of a plane, so its slope leads to the
// neighbours' centres.
void gnomonFindPixel(float ownDepth, vec2 depthPerPixel)
{
  ivec2 own = ivec2(gl_FragCoord.xy) - gnomonOrigin;
  ivec2 last = textureSize(gnomonDepths, 0) - 1;
  // On the plane, depths differ by their rounding, or by the plane's rise in 1/64 pixel.
  float onPlane = 2.4e-7 + (abs(depthPerPixel.x) + abs(depthPerPixel.y)) / 64.0;
  // A surface that the snapshot does not hold is in no layer, and its plane may be an impostor's.
  float least = gnomonDrawnVSOutput.x < 0 ? 0.0 : 1e30;
  gnomonPixel = own;
  for (int i = 0; i < 5; ++i)
  {
    ivec2 pixel = clamp(own + gnomonAround[i], ivec2(0), last);
    float shown = texelFetch(gnomonDepths, pixel, 0).r;
    float depth = ownDepth + dot(depthPerPixel, vec2(pixel - own));
    float off = max(abs(shown - depth), onPlane);
    if (off < least && shown < 1.0) // 1: background
    {
      least = off;
      gnomonPixel = pixel;
    }
  }
}

ivec2 gnomonLayerPixel()
{
  return gnomonPixel;
}
