// The surface's identity where receivers are drawn: alone (image route) or with the picture
// (deferred route).

uniform int gnomonDrawn; // the drawn surface's number, -1 if the snapshot does not hold it
uniform int gnomonPrimitivesPerInstance; // of a surface that is drawn as instances

// Return the surface's number + 1, negative if it shows no shadows.
float gnomonDrawnSurface()
{
  return float(gnomonDrawn + 1) * (gnomonReceives == 1 ? 1.0 : -1.0);
}
