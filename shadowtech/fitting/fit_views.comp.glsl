// Computes the last fit of each view from the receivers' bounds: the twin of fitTo() and
// fitSnappedTo() (lights/MapFit.h), one invocation per view.
#include "shadowtech/base/fit_rows.glsl"
#include "shadowtech/fitting/bounds_buffer.glsl"

layout(local_size_x = 1) in;
layout(rgba32f, binding = 0) writeonly uniform image2D viewFits;

uniform float side;    // of the map, in texels
uniform float inside;  // the share of [-1, 1] that lies inside of the border
uniform float covered; // +- this, before the fit, holds all that can be visible
uniform float leastShare; // leastVisibleShare
uniform int snapped;

// Return the size 2^(k/4) of the series.
float seriesSize(int k)
{
  float[] roots = float[](1.0, 1.18920712, 1.41421356, 1.68179283);
  return roots[k & 3] * float(1 << (k >> 2));
}

vec2 fitAxis(float lower, float upper)
{
  float all = 2.0 * covered;
  float least = leastShare * all;
  if (!(upper - lower >= least))
  {
    lower = clamp(0.5 * (lower + upper) - 0.5 * least, -covered, covered - least);
    upper = lower + least;
  }
  float seen = upper - lower;
  float centre = 0.5 * (lower + upper);
  if (snapped == 0)
  {
    float scale = 2.0 * inside / seen;
    return vec2(scale, -scale * centre);
  }
  float texel = 2.0 / side;
  int k = 0;
  while (k < 64 && seriesSize(k + 1) * seen <= all)
  {
    ++k;
  }
  float scale = 2.0 * (inside - 0.5 * texel) / all * seriesSize(k);
  return vec2(scale, floor(-scale * centre / texel + 0.5) * texel);
}

void main()
{
  int view = int(gl_GlobalInvocationID.x);
  // Without receivers, this fit puts everything off the map, so nothing is drawn or found.
  vec4 fit = vec4(0.0, 0.0, 4.0, 4.0);
  if (!isEmpty(view))
  {
    vec3 lower = lowerOf(view);
    vec3 upper = upperOf(view);
    vec2 lowerMap = clamp(lower.xy / (0.5 * side) - 1.0, -covered, covered);
    vec2 upperMap = clamp(upper.xy / (0.5 * side) - 1.0, -covered, covered);
    vec2 x = fitAxis(lowerMap.x, upperMap.x);
    vec2 y = fitAxis(lowerMap.y, upperMap.y);
    fit = vec4(x.x, y.x, x.y, y.y);
  }
  imageStore(viewFits, ivec2(view, DEVICE_FIT_ROW), fit);
  imageStore(viewFits, ivec2(view, TEXEL_FIT_ROW),
    vec4(fit.xy, 0.5 * side * (fit.zw + 1.0 - fit.xy)));
}
