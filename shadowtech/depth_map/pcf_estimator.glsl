// Percentage closer filtering (Reeves, Salesin and Cook 1987): the share of the light's kernel that
// nothing hides. Pcf.h describes the kernels; PCF_TEXELS_LIGHT is their width. Macros select how
// the map is read:
// - PCF_DISC_LIGHT: DISC_POINTS_LIGHT points of a disc, of which the first DISC_RING_LIGHT lie on
//   its rim, and fewer where the whole disc is lit or hidden;
// - PCF_ROWS_LIGHT: the bilinear kernel in units of texels;
// - PCF_WEIGHTED_LIGHT: all texels of a bilinear or Castano's kernel;
// - PCF_POISSON_LIGHT: points of a disc;
// - else taps, which PCF_BOX_LIGHT makes single texels.
//
// The estimator sums hidden shares, not lit ones, so that a lit point's visibility is exactly 1.

#include "shadowtech/base/kernel_units.glsl"
#include "shadowtech/base/share.glsl"
#include "shadowtech/depth_map/kernel.glsl"

#if PCF_DISC_LIGHT

#if DISC_ASKS_BOUNDS_LIGHT
#include "shadowtech/depth_map/depth_bounds.glsl"
#endif

uniform sampler2DArray discs_LIGHT; // a layer for each point, a texel for each disc

// Return the sum of hidden shares over some of the disc's points.
float hiddenOf_LIGHT(ViewPoint point, mat2 shape, ivec2 disc, int first, int end, float slack)
{
  float hidden = 0.0;
  for (int i = first; i < end; ++i)
  {
    vec2 offset = shape * texelFetch(discs_LIGHT, ivec3(disc, i), 0).rg;
    hidden += hidden_LIGHT(point, ivec2(floor(point.texel + offset)), slack);
  }
  return hidden;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 shape = 0.5 * float(PCF_TEXELS_LIGHT) * kernelShape_LIGHT(point);
#if DISC_ASKS_BOUNDS_LIGHT
  vec2 reach = vec2(length(vec2(shape[0].x, shape[1].x)), length(vec2(shape[0].y, shape[1].y)));
  float decided = decided_LIGHT(point, reach, slack);
  if (decided >= 0.0)
  {
    return decided;
  }
#endif
  ivec2 disc = ivec2(4.0 * point.texel) % DISC_SETS_LIGHT;
  float hidden = hiddenOf_LIGHT(point, shape, disc, 0, DISC_RING_LIGHT, slack);
#if DISC_ASKS_RING_LIGHT
  if (hidden == 0.0 || hidden == float(DISC_RING_LIGHT))
  {
    return hidden == 0.0 ? 1.0 : 0.0;
  }
#endif
  hidden += hiddenOf_LIGHT(point, shape, disc, DISC_RING_LIGHT, DISC_POINTS_LIGHT, slack);
  return 1.0 - shareOf(hidden, float(DISC_POINTS_LIGHT));
}

#else

#if PCF_CASTANO_LIGHT
// Return a place's weight by its distance along an axis, in kernel units.
float weight_LIGHT(float away)
{
  int before = int(away);
  return before > PCF_TEXELS_LIGHT / 2
    ? 0.0
    : mix(castano_LIGHT[before], castano_LIGHT[before + 1], away - float(before));
}
#else
float weight_LIGHT(float away)
{
  return clamp(0.5 * float(PCF_TEXELS_LIGHT + 1) - away, 0.0, 1.0);
}
#endif

// Return the bilinear mean of the comparisons around a place.
float hiddenBilinear_LIGHT(ViewPoint point, vec2 place, float slack)
{
  vec2 corner = place - 0.5;
  ivec2 first = ivec2(floor(corner));
  vec2 share = corner - vec2(first);
  return mix(mix(hidden_LIGHT(point, first, slack), hidden_LIGHT(point, first + ivec2(1, 0), slack),
               share.x),
    mix(hidden_LIGHT(point, first + ivec2(0, 1), slack),
      hidden_LIGHT(point, first + ivec2(1, 1), slack), share.x),
    share.y);
}

#if PCF_ROWS_LIGHT

// Return the hidden texels of a row of the kernel's square. The first and the last texel have
// shares that sum to one texel.
float hiddenInRow_LIGHT(ViewPoint point, ivec2 first, float shareOfLast, float slack)
{
  float hidden = hidden_LIGHT(point, first, slack);
  hidden += shareOfLast * (hidden_LIGHT(point, first + ivec2(PCF_TEXELS_LIGHT, 0), slack) - hidden);
  for (int x = 1; x < PCF_TEXELS_LIGHT; ++x)
  {
    hidden += hidden_LIGHT(point, first + ivec2(x, 0), slack);
  }
  return hidden;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  vec2 corner = point.texel - 0.5 * float(PCF_TEXELS_LIGHT);
  ivec2 first = ivec2(floor(corner));
  vec2 shareOfLast = corner - vec2(first);
  float hidden = hiddenInRow_LIGHT(point, first, shareOfLast.x, slack);
  hidden += shareOfLast.y *
    (hiddenInRow_LIGHT(point, first + ivec2(0, PCF_TEXELS_LIGHT), shareOfLast.x, slack) - hidden);
  for (int y = 1; y < PCF_TEXELS_LIGHT; ++y)
  {
    hidden += hiddenInRow_LIGHT(point, first + ivec2(0, y), shareOfLast.x, slack);
  }
  return 1.0 - shareOf(hidden, float(PCF_TEXELS_LIGHT * PCF_TEXELS_LIGHT));
}

#elif PCF_WEIGHTED_LIGHT

// Weigh all texels in the kernel's shape.
float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 shape = kernelShape_LIGHT(point); // of determinant 1
  mat2 inverseShape = mat2(shape[1].y, -shape[0].y, -shape[1].x, shape[0].x);
  float side = 0.5 * float(PCF_TEXELS_LIGHT + 1);
  vec2 reach = side * (abs(shape[0]) + abs(shape[1]));
  // The extent along a row between either pair of the shape's sides, unbounded if they run along
  // it.
  vec2 perTexel = inverseShape[0];
  perTexel = mix(perTexel, vec2(1e-6), lessThan(abs(perTexel), vec2(1e-6)));
  vec2 extent = side / abs(perTexel);
  float hidden = 0.0;
  float all = 0.0;
  int lastRow = int(floor(point.texel.y + reach.y - 0.5));
  for (int y = int(ceil(point.texel.y - reach.y - 0.5)); y <= lastRow; ++y)
  {
    vec2 middle = -inverseShape[1] * (float(y) + 0.5 - point.texel.y) / perTexel;
    float first = max(max(middle.x - extent.x, middle.y - extent.y), -reach.x);
    float last = min(min(middle.x + extent.x, middle.y + extent.y), reach.x);
    int lastInRow = int(floor(point.texel.x + max(last, -reach.x) - 0.5));
    for (int x = int(ceil(point.texel.x + min(first, reach.x) - 0.5)); x <= lastInRow; ++x)
    {
      vec2 away = abs(inverseShape * (vec2(x, y) + 0.5 - point.texel));
      float weight = weight_LIGHT(away.x) * weight_LIGHT(away.y);
      hidden += weight > 0.0 ? weight * hidden_LIGHT(point, ivec2(x, y), slack) : 0.0;
      all += weight;
    }
  }
  // all > 0: the limited stretch leaves a circle of the bilinear filter's radius, 1, which holds a
  // texel.
  return 1.0 - shareOf(hidden, all);
}

#elif PCF_POISSON_LIGHT

float estimate_LIGHT(ViewPoint point, float slack)
{
  float angle = 6.2831853 * noise_LIGHT(ivec2(4.0 * point.texel));
  vec2 axis = 0.5 * float(PCF_TEXELS_LIGHT) * vec2(cos(angle), sin(angle));
  mat2 turn = kernelShape_LIGHT(point) * mat2(axis, vec2(-axis.y, axis.x));
  float hidden = 0.0;
  for (int i = 0; i < PCF_POINTS_LIGHT; ++i)
  {
    ivec2 texel = ivec2(floor(point.texel + turn * poissonDisc_LIGHT[i]));
    hidden += hidden_LIGHT(point, texel, slack);
  }
  return 1.0 - shareOf(hidden, float(PCF_POINTS_LIGHT));
}

#else

// Sum taps that lie a kernel unit apart.
float estimate_LIGHT(ViewPoint point, float slack)
{
  mat2 shape = kernelShape_LIGHT(point);
  float middle = 0.5 * float(PCF_TEXELS_LIGHT - 1);
  vec2 first = point.texel - shape * vec2(middle);
  float hidden = 0.0;
  float all = 0.0;
  for (int y = 0; y < PCF_TEXELS_LIGHT; ++y)
  {
    for (int x = 0; x < PCF_TEXELS_LIGHT; ++x)
    {
      vec2 place = first + shape * vec2(x, y);
#if PCF_BOX_LIGHT
      hidden += hidden_LIGHT(point, ivec2(floor(place)), slack);
      all += 1.0;
#else
      float weight = weight_LIGHT(abs(float(x) - middle)) * weight_LIGHT(abs(float(y) - middle));
      hidden += weight * hiddenBilinear_LIGHT(point, place, slack);
      all += weight;
#endif
    }
  }
  return 1.0 - shareOf(hidden, all);
}

#endif

#endif
