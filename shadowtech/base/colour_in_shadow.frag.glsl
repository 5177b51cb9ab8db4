// What a pixel in shadow looks like (DeferredPicture.h); lit ones stay as they are.

uniform sampler2D inShadow;
#ifdef SOME_ARE_LIT
uniform sampler2DArray visibility;
uniform ivec2 origin; // of the picture in its framebuffer
#endif

out vec4 colour;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#ifdef SOME_ARE_LIT
  if (texelFetch(visibility, ivec3(pixel - origin, 0), 0).r > 0.0)
  {
    discard;
  }
#endif
  colour = texelFetch(inShadow, pixel, 0);
}
