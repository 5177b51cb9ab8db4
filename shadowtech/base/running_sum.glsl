// Reads the sum so far of an image that several draws add to (RunningSum.h).

uniform sampler2D sumBefore;
uniform int sumIsEmpty; // 1: nothing was added, and the image is undefined

vec4 summedBefore(ivec2 pixel)
{
  return sumIsEmpty == 1 ? vec4(0.0) : texelFetch(sumBefore, pixel, 0);
}
