// Draws the colours of pixels in shadow (DeferredPicture.h); lit pixels stay as they are.

uniform sampler2D inShadow;
#ifdef SOME_ARE_LIT
#if defined(MIXES)
uniform sampler2D visibility;
#elif defined(BIT)
uniform usampler2D visibility; // in the lowest bit
#else
uniform sampler2DArray visibility; // in the first layer
#endif
uniform ivec2 origin; // of the picture in its framebuffer
#endif

out vec4 colour; // MIXES: alpha is the share of shadow, for blending

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  colour = texelFetch(inShadow, pixel, 0);
#ifdef SOME_ARE_LIT
#if defined(MIXES)
  float lit = texelFetch(visibility, pixel - origin, 0).r;
#elif defined(BIT)
  float lit = float(texelFetch(visibility, pixel - origin, 0).r & 1u);
#else
  float lit = texelFetch(visibility, ivec3(pixel - origin, 0), 0).r;
#endif
#ifdef MIXES
  colour.a = 1.0 - lit;
#else
  if (lit > 0.0)
  {
    discard;
  }
#endif
#endif
}
