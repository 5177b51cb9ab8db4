// The comparison of filters with the texels of a depth map.

#include "shadowtech/depth_map/depth_map.glsl"

// Return 1 if the point is hidden at a texel, else 0. The border ensures that casters lie inside
// the layer. Only kernels wider than the border read the layer's last texel again.
float hidden_LIGHT(ViewPoint point, ivec2 texel, float slack)
{
  ivec2 inside = clamp(texel, ivec2(0), ivec2(int(viewSize_LIGHT) - 1));
  return isLitAt_LIGHT(point, inside, slack) ? 0.0 : 1.0;
}

// Return a number in [0, 1) for each cell of the map that looks random ("lowbias32", Wellons 2018).
float noise_LIGHT(ivec2 cell)
{
  uint bits = uint(cell.x) + 65536u * uint(cell.y);
  bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
  bits ^= bits >> 16u;
  return float(bits >> 8u) / 16777216.0;
}
