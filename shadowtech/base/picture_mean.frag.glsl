// Draws the mean of the added pictures (PictureMean.h), with the depths of one of them.

#include "shadowtech/base/drawn_picture.glsl"

uniform sampler2D sum;
uniform float pictures;
uniform PICTURE_SAMPLER depths;
uniform ivec2 origin; // of the picture in the framebuffer
#ifdef ENCODED
uniform float gamma;
#endif

out vec4 colour;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy) - origin;
  colour = texelFetch(sum, pixel, 0) / pictures;
#ifdef ENCODED
  colour.rgb = pow(colour.rgb, vec3(1.0 / gamma));
#endif
  gl_FragDepth = texelFetch(depths, pixel, 0).r;
}
