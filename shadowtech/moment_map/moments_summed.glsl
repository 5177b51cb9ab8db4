// Lookups of moments in a summed-area table, each over its own rectangle.

#include "shadowtech/base/kernel_units.glsl"
#include "shadowtech/moment_map/summed_area.glsl"

uniform float widestKernel_LIGHT; // in texels; the table's units are made for it

// Return the width of the kernel around a point along both axes of the map. It belongs to the
// rectangle with the kernel's variance along each axis.
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  mat2 shape = kernelShape_LIGHT(point);
  vec2 spread =
    vec2(length(vec2(shape[0].x, shape[1].x)), length(vec2(shape[0].y, shape[1].y)));
  return clamp(float(KERNEL_TEXELS_LIGHT) * spread, 1.0, widestKernel_LIGHT);
}

// Return the moments over a rectangle of that width around a point.
vec4 momentsAt_LIGHT(ViewPoint point)
{
  vec2 halfWidth = 0.5 * kernelTexels_LIGHT(point);
  return meanOver_LIGHT(point.texel - halfWidth, point.texel + halfWidth, point.view);
}
