// The shape of a filter's kernel on the map around a point (lights/KernelShape.h).
//
// - KERNEL_EVEN_LIGHT: the shape is even across the light, and its area counts in texels.
// - KERNEL_ACROSS_LIGHT: its units are a length across the light.
// - Neither: its units are texels.

#include "shadowtech/base/light_views.glsl"

#if KERNEL_EVEN_LIGHT || KERNEL_ACROSS_LIGHT
uniform float kernelUnit_LIGHT; // the largest stretch; or a unit's length across the light
#endif

// Return the matrix from kernel units to texels.
mat2 kernelShape_LIGHT(ViewPoint point)
{
#if KERNEL_EVEN_LIGHT
  vec2 across = acrossOf_LIGHT(point.position);
  return evenShape(texelJacobian_LIGHT(point.view, across), kernelUnit_LIGHT);
#elif KERNEL_ACROSS_LIGHT
  vec2 across = acrossOf_LIGHT(point.position);
  return kernelUnit_LIGHT * texelJacobian_LIGHT(point.view, across);
#else
  return mat2(1.0);
#endif
}
