// Computes the size of a warp's texels on the receivers, over pixels of a grid all over the
// picture. The size is the mean of both sides of a texel, across the light and in world units
// (ReceiverFit.h gives the reason). One work group per warp.
//
// The order of the sums is fixed, so that the same picture gives the same number. Pixels between
// those of the grid change the mean by little. The bounds of the map's final fit come from all
// pixels.

#include "shadowtech/fitting/receivers.glsl"

layout(local_size_x = SAMPLES) in;
layout(std430, binding = 0) writeonly buffer Sides { float texelSides[]; };

uniform sampler2D warps; // a column per warp; rows 0 to 2: mapFromAcross

// Sums over the receivers of one column of the grid, then of several.
struct Seen
{
  vec2 lower; // on the map, in device coordinates
  vec2 upper;
  vec2 sides; // sum of the sides of a square of 1 in device coordinates
  float count;
};
shared Seen seen[SAMPLES];

Seen both(Seen a, Seen b)
{
  return Seen(min(a.lower, b.lower), max(a.upper, b.upper), a.sides + b.sides, a.count + b.count);
}

vec2 placeUnder(mat3 homography, vec2 across)
{
  vec3 image = homography * vec3(across, 1.0);
  return image.xy / image.z; // w > 0 at all visible points
}

void add(ivec2 pixel, mat3 uniformMap, mat3 warp, inout Seen total)
{
  vec4 point = texelFetch(receiverPoints, pixel, 0);
  vec3 p = lightFromView(point.xyz);
  vec2 across = acrossOf_LIGHT(p);
  // Visible points lie on the uniform map; off it, no caster can shadow.
  if (!isReached(pixel, point) || any(greaterThan(abs(placeUnder(uniformMap, across)), vec2(1.0))))
  {
    return;
  }
  vec2 place = placeUnder(warp, across);
  mat2 jacobian = homographyJacobian(warp, across);
  float area = determinant(jacobian); // > 0, of maps that mirror nothing
#if VIEWS_PERSPECTIVE_LIGHT
  float reach = p.z;
#else
  float reach = 1.0;
#endif
  vec2 sides = reach / area *
    vec2(length(vec2(jacobian[1].y, jacobian[0].y)), length(vec2(jacobian[1].x, jacobian[0].x)));
  if (isFinite(vec3(place, sides.x + sides.y)))
  {
    total = both(total, Seen(place, place, sides, 1.0));
  }
}

void main()
{
  int column = int(gl_LocalInvocationID.x);
  int number = int(gl_WorkGroupID.x);
  mat3 uniformMap = fetchHomography(warps, 0, 0);
  mat3 warp = fetchHomography(warps, number, 0);
  ivec2 size = textureSize(receiverPoints, 0);
  Seen total = Seen(vec2(infinity), vec2(-infinity), vec2(0.0), 0.0);
  for (int row = 0; row < SAMPLES; ++row)
  {
    vec2 place = (vec2(column, row) + 0.5) / float(SAMPLES);
    add(min(ivec2(place * vec2(size)), size - 1), uniformMap, warp, total);
  }
  seen[column] = total;
  for (int step = SAMPLES / 2; step > 0; step /= 2)
  {
    barrier();
    if (column < step)
    {
      seen[column] = both(seen[column], seen[column + step]);
    }
  }
  if (column == 0)
  {
    // The last fit makes the visible part as large as the map. Without receivers no warp is better.
    vec2 extent = max(seen[0].upper - seen[0].lower, vec2(0.0));
    texelSides[number] = seen[0].count > 0.0 ? dot(seen[0].sides, extent) / seen[0].count : 0.0;
  }
}
