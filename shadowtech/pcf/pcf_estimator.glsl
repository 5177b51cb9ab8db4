// Percentage closer filtering (Reeves, Salesin and Cook 1987): the share of the light's kernel that
// nothing hides. Pcf.h describes the kernels; PCF_TEXELS_LIGHT is their width, PCF_BILINEAR_LIGHT and
// PCF_POISSON_LIGHT say which it is (neither: a box).
//
// What is hidden is added up, not what is lit, so that a lit point's visibility is 1 exactly.

#include "shadowtech/depth_map/depth_map.glsl"

// 1 where the point is hidden at a texel, else 0. The border makes sure that casters lie inside the
// layer; only kernels that are wider than it read the layer's last texel again.
float hidden_LIGHT(ViewPoint point, ivec2 texel, float slack)
{
  ivec2 inside = clamp(texel, ivec2(0), ivec2(int(viewSize_LIGHT) - 1));
  return isLitAt_LIGHT(point, inside, slack) ? 0.0 : 1.0;
}

#if PCF_BILINEAR_LIGHT

// What a row of the kernel's square covers: all of its texels, but of the first and the last only
// shares, which make up one texel.
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
  return max(1.0 - hidden / float(PCF_TEXELS_LIGHT * PCF_TEXELS_LIGHT), 0.0);
}

#elif PCF_POISSON_LIGHT

// A number in [0, 1) for each cell of the map, random to the eye ("lowbias32", Wellons 2018).
float noise_LIGHT(ivec2 cell)
{
  uint bits = uint(cell.x) + 65536u * uint(cell.y);
  bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
  bits ^= bits >> 16u;
  return float(bits >> 8u) / 16777216.0;
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  float angle = 6.2831853 * noise_LIGHT(ivec2(4.0 * point.texel));
  vec2 axis = 0.5 * float(PCF_TEXELS_LIGHT) * vec2(cos(angle), sin(angle));
  mat2 turn = mat2(axis, vec2(-axis.y, axis.x));
  float hidden = 0.0;
  for (int i = 0; i < PCF_POINTS_LIGHT; ++i)
  {
    ivec2 texel = ivec2(floor(point.texel + turn * poissonDisc_LIGHT[i]));
    hidden += hidden_LIGHT(point, texel, slack);
  }
  return max(1.0 - hidden / float(PCF_POINTS_LIGHT), 0.0);
}

#else

float estimate_LIGHT(ViewPoint point, float slack)
{
  ivec2 first = ivec2(floor(point.texel - 0.5 * float(PCF_TEXELS_LIGHT - 1)));
  float hidden = 0.0;
  for (int y = 0; y < PCF_TEXELS_LIGHT; ++y)
  {
    for (int x = 0; x < PCF_TEXELS_LIGHT; ++x)
    {
      hidden += hidden_LIGHT(point, first + ivec2(x, y), slack);
    }
  }
  return max(1.0 - hidden / float(PCF_TEXELS_LIGHT * PCF_TEXELS_LIGHT), 0.0);
}

#endif
