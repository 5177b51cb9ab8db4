// The rows of the texture with a light's fits and chosen warps, found on the GPU, a column per view
// (shadowtech/fitting/ReceiverFit.h).

#ifndef GNOMON_FIT_ROWS
#define GNOMON_FIT_ROWS

#define DEVICE_FIT_ROW 0 // the last fit F: scale and offset in device coordinates
#define TEXEL_FIT_ROW 1  // the same in texels
// The chosen warp, if the light chooses one: three rows hold a matrix' columns.
#define TEXEL_FROM_ACROSS_ROW 2
#define ACROSS_FROM_TEXEL_ROW 5
#define WARP_FROM_UNIFORM_ROW 8 // in device coordinates, from the view's uniform map

mat3 fetchHomography(sampler2D fits, int view, int row)
{
  return mat3(texelFetch(fits, ivec2(view, row), 0).xyz,
    texelFetch(fits, ivec2(view, row + 1), 0).xyz, texelFetch(fits, ivec2(view, row + 2), 0).xyz);
}

#endif
