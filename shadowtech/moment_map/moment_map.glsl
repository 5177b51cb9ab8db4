// Techniques with a map of moments: the mean moments around a point, and what their estimators do
// with a bound on the share of the map's depths that lie behind the point (MomentMapTechnique.h).
//
// KERNEL_TEXELS_LIGHT is the kernel's width; MOMENTS_SUMMED_LIGHT: the map is a summed-area table, else
// it was blurred with a box of that width. BLEEDING_LIGHT is the bound up to which a point is in full
// shadow.

#include "shadowtech/base/map_visibility.glsl"

#if MOMENTS_SUMMED_LIGHT

#include "shadowtech/base/kernel_units.glsl"
#include "shadowtech/moment_map/summed_area.glsl"

uniform float widestKernel_LIGHT; // in texels: what the table's units are made for

// The width of the kernel around a point along both axes of the map: of the rectangle whose
// variance along each of them is that of the kernel in its shape.
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  mat2 shape = kernelShape_LIGHT(point);
  vec2 spread =
    vec2(length(vec2(shape[0].x, shape[1].x)), length(vec2(shape[0].y, shape[1].y)));
  return clamp(float(KERNEL_TEXELS_LIGHT) * spread, 1.0, widestKernel_LIGHT);
}

// The moments of what a rectangle of that width covers around a point.
vec4 momentsAt_LIGHT(ViewPoint point)
{
  vec2 halfWidth = 0.5 * kernelTexels_LIGHT(point);
  return meanOver_LIGHT(point.texel - halfWidth, point.texel + halfWidth, point.view);
}

#else

uniform sampler2DArray momentMap_LIGHT; // linear; its border has the moments of depth 1

// The width of the kernel along both axes of the map.
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  return vec2(KERNEL_TEXELS_LIGHT);
}

// The moments of what a square of the box's width covers around a point: the bilinear filter adds the
// part of a texel that moves it from the middle of its texel (of a box of even width, from that
// texel's lower corner) to the point.
vec4 momentsAt_LIGHT(ViewPoint point)
{
  vec2 place = point.texel + (KERNEL_TEXELS_LIGHT % 2 == 0 ? 0.5 : 0.0);
  return textureLod(momentMap_LIGHT, vec3(place / viewSize_LIGHT, float(point.view)), 0.0);
}

#endif

// The receiver's depth, nearer by its rounding and by a bias in depths of [0, 1], from [0, 1] to [-1, 1]
// as that of the moments. Receivers that do not cast may lie behind all depths of the map: as far away
// as empty texels.
float centredDepth_LIGHT(ViewPoint point, float bias)
{
  return 2.0 * clamp(viewDepth_LIGHT(point, point.position.z) - bias, 0.0, 1.0) - 1.0;
}

// By how much the depth of the receiver's plane changes from texel to texel along both axes.
vec2 planeSlope_LIGHT(ViewPoint point)
{
  vec2 x = vec2(0.5, 0.0);
  vec2 y = vec2(0.0, 0.5);
  vec2 nearest = vec2(min(planeDistance_LIGHT(point, point.texel - x),
                        planeDistance_LIGHT(point, point.texel + x)),
    min(planeDistance_LIGHT(point, point.texel - y), planeDistance_LIGHT(point, point.texel + y)));
  return 2.0 * viewDepths_LIGHT[point.view].x * (point.position.z - nearest);
}

// The bound as a visibility: what bleeds through is cut off, and the rest spread over [0, 1].
float withoutBleeding_LIGHT(float bound)
{
  return clamp((bound - BLEEDING_LIGHT) / (1.0 - BLEEDING_LIGHT), 0.0, 1.0);
}
