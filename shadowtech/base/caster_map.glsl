// How the map that casters are drawn into lies across the light, at the fragment (CasterDrawing.h).

#include "shadowtech/base/kernel_shape.glsl"

// Both are for texels before the last fit.
uniform mat3 texelFromAcross;
uniform mat3 acrossFromTexel;

#ifdef FITTED
uniform sampler2D viewFits; // at (view, 1): the view's last fit, in texels
uniform int view;
#endif

// texel = xy * texel before the fit + zw; xy is not 0 where anything is drawn.
vec4 lastFit()
{
#ifdef FITTED
  return texelFetch(viewFits, ivec2(view, 1), 0);
#else
  return vec4(1.0, 1.0, 0.0, 0.0);
#endif
}

// Where the fragment is across the light.
vec2 across()
{
  vec4 fit = lastFit();
  vec3 place = acrossFromTexel * vec3((gl_FragCoord.xy - fit.zw) / fit.xy, 1.0);
  return place.xy / place.z; // not 0 on the map
}

// d texel / d across there.
mat2 texelJacobian()
{
  vec4 fit = lastFit();
  mat2 beforeFit = homographyJacobian(texelFromAcross, across());
  return mat2(fit.xy * beforeFit[0], fit.xy * beforeFit[1]);
}

// A texel's size across the light is this, times (texel, 1), squared, but for a factor.
vec3 texelScale()
{
  vec4 fit = lastFit();
  vec3 beforeFit = vec3(acrossFromTexel[0].z, acrossFromTexel[1].z, acrossFromTexel[2].z);
  vec2 slope = beforeFit.xy / fit.xy;
  return vec3(slope, beforeFit.z - dot(slope, fit.zw));
}
