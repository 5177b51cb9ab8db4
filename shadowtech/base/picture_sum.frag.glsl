// Adds a picture to the sum so far (PictureMean.h).

#include "shadowtech/base/drawn_picture.glsl"
#include "shadowtech/base/running_sum.glsl"

uniform PICTURE_SAMPLER picture;
#ifdef ENCODED
uniform float gamma;
#endif

out vec4 sum;

#if SAMPLES > 1
// Resolve a pixel's samples as VTK's windows do, which take colours for 2.2th roots of light.
vec4 colourAt(ivec2 pixel)
{
  const float gammaOfWindows = 2.2;
  vec4 mean = vec4(0.0);
  for (int i = 0; i < SAMPLES; ++i)
  {
    vec4 colour = texelFetch(picture, pixel, i);
    mean += vec4(pow(max(colour.rgb, 0.0), vec3(gammaOfWindows)), colour.a) / float(SAMPLES);
  }
  return vec4(pow(mean.rgb, vec3(1.0 / gammaOfWindows)), mean.a);
}
#else
vec4 colourAt(ivec2 pixel)
{
  return texelFetch(picture, pixel, 0);
}
#endif

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 colour = colourAt(pixel);
#ifdef ENCODED
  colour.rgb = pow(max(colour.rgb, 0.0), vec3(gamma));
#endif
  sum = summedBefore(pixel) + colour;
}
