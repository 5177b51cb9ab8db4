// Where the fragment of a caster lies across the light, from the layout of the map that is baked
// (CasterDrawing.h).

#include "shadowtech/base/fit_rows.glsl"
#include "shadowtech/base/kernel_shape.glsl"

#ifdef FITTED
uniform sampler2D viewFits;
uniform int view;
#endif

// Both homographies are for texels before the last fit.
#ifdef CHOSEN
mat3 texelHomography()
{
  return fetchHomography(viewFits, view, TEXEL_FROM_ACROSS_ROW);
}
mat3 acrossHomography()
{
  return fetchHomography(viewFits, view, ACROSS_FROM_TEXEL_ROW);
}
#else
uniform mat3 texelFromAcross;
uniform mat3 acrossFromTexel;
mat3 texelHomography()
{
  return texelFromAcross;
}
mat3 acrossHomography()
{
  return acrossFromTexel;
}
#endif

// texel = xy * texel before the fit + zw; xy is not 0 where anything is drawn.
vec4 lastFit()
{
#ifdef FITTED
  return texelFetch(viewFits, ivec2(view, TEXEL_FIT_ROW), 0);
#else
  return vec4(1.0, 1.0, 0.0, 0.0);
#endif
}

vec2 across()
{
  vec4 fit = lastFit();
  vec3 place = acrossHomography() * vec3((gl_FragCoord.xy - fit.zw) / fit.xy, 1.0);
  return place.xy / place.z; // not 0 on the map
}

// Return d texel / d across at the fragment.
mat2 texelJacobian()
{
  vec4 fit = lastFit();
  mat2 beforeFit = homographyJacobian(texelHomography(), across());
  return mat2(fit.xy * beforeFit[0], fit.xy * beforeFit[1]);
}

// Return s with: the longer side of a texel across the light is 1 / (s . (texel, 1))^2, up to a
// constant factor.
vec3 texelScale()
{
  vec4 fit = lastFit();
  mat3 homography = acrossHomography();
  vec3 beforeFit = vec3(homography[0].z, homography[1].z, homography[2].z);
  vec2 slope = beforeFit.xy / fit.xy;
  return vec3(slope, beforeFit.z - dot(slope, fit.zw));
}
