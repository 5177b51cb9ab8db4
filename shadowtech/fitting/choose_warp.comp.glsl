// Chooses the warp with the smallest texels, or the uniform map, which is the first one, if that is
// about as good.

#include "shadowtech/base/fit_rows.glsl"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Sides { float texelSides[]; };
layout(rgba32f, binding = 0) writeonly uniform image2D viewFits;

uniform sampler2D warps; // a column per warp; rows from 3 on are copied if chosen
uniform float largestShare; // of the uniform map's side, up to which a warp is chosen

void main()
{
  int chosen = 0;
  float least = largestShare * texelSides[0];
  for (int i = 1; i < textureSize(warps, 0).x; ++i)
  {
    // NaN is not less.
    if (texelSides[i] < least)
    {
      chosen = i;
      least = texelSides[i];
    }
  }
  for (int row = 3; row < textureSize(warps, 0).y; ++row)
  {
    imageStore(viewFits, ivec2(0, TEXEL_FROM_ACROSS_ROW + row - 3),
      texelFetch(warps, ivec2(chosen, row), 0));
  }
}
