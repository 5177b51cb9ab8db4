// What was added so far to an image that several draws add to (RunningSum.h).

uniform sampler2D sumBefore;
uniform int sumIsEmpty; // 1: nothing was, and the image holds anything

vec4 summedBefore(ivec2 pixel)
{
  return sumIsEmpty == 1 ? vec4(0.0) : texelFetch(sumBefore, pixel, 0);
}
