// The image route's declarations: one visibility layer per casting light without a bit
// (hook_bits.glsl). What follows says which pixel is fetched (hook_pixel.glsl,
// hook_pixel_multisample.glsl), and fetches its layers one by one (hook_layer.glsl) or in a loop
// (hook_layers.glsl).

uniform sampler2DArray gnomonLayers;
uniform ivec2 gnomonOrigin; // the window pixel that the layers' first pixel belongs to
uniform int gnomonStage;    // 1: this is the receivers stage
