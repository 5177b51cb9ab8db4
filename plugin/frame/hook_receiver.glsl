// The surface's identity where receivers are drawn: alone (image route) or with the picture
// (deferred route).

// Return the surface's number + 1, negative if it shows no shadows.
float gnomonDrawnSurface()
{
  return float(gnomonDrawnVSOutput.x + 1) * (gnomonReceives == 1 ? 1.0 : -1.0);
}
