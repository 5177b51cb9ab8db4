// The image route's declarations: one visibility layer per casting light. What follows says which
// pixel is fetched (hook_pixel.glsl, hook_pixel_multisample.glsl), and fetches its layers one by
// one (hook_layer.glsl) or in a loop (hook_layers.glsl).

uniform sampler2DArray gnomonLayers;
uniform ivec2 gnomonOrigin; // the window pixel that the layers' first pixel belongs to
uniform int gnomonStage;    // 1: this is the receivers stage
uniform int gnomonDrawn;    // the drawn surface's number, -1 if the snapshot does not hold it
uniform int gnomonPrimitivesPerInstance; // of a surface that is drawn as instances

// What the receivers stage says of the surface: its number + 1, negative if it shows no shadows.
float gnomonDrawnSurface()
{
  return float(gnomonDrawn + 1) * (gnomonReceives == 1 ? 1.0 : -1.0);
}
