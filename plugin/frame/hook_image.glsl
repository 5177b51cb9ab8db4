// The image route's declarations: one visibility layer per casting light without a bit
// (hook_bits.glsl). The next parts choose the pixel to fetch (hook_pixel.glsl,
// hook_pixel_multisample.glsl), and fetch its layers one by one (hook_layer.glsl) or in a loop
// (hook_layers.glsl).

uniform sampler2DArray gnomonLayers;
uniform ivec2 gnomonOrigin; // the window pixel of the layers' first pixel
// gnomonStage: 1 in the receivers stage; a constant in programs of one stage
