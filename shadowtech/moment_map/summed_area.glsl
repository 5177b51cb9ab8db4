// Computes means over rectangles of a map from its summed-area table (SummedAreaTable.h).

uniform usampler2DArray momentTable_LIGHT; // sums of all texels up to each, in units, modulo 2^32
uniform vec4 tableUnits_LIGHT;             // number of units in 1
uniform vec4 emptyMoments_LIGHT;           // the value outside a layer

// Return the sum over all texels before one along both axes.
uvec4 sumBefore_LIGHT(ivec2 texel, int layer)
{
  uvec4 sum = texelFetch(momentTable_LIGHT, ivec3(max(texel - 1, 0), layer), 0);
  return all(greaterThan(texel, ivec2(0))) ? sum : uvec4(0u);
}

// Return the mean over a rectangle at any place, in texels, where partly covered texels count in
// part. Along an axis it is the interval up to the last whole texel, plus a share of the last, less
// a share of the first. These are three intervals with one beginning. Their products with those of
// the other axis are rectangles of whole texels, whose sums do not wrap.
vec4 meanOver_LIGHT(vec2 lower, vec2 upper, int layer)
{
  ivec2 size = textureSize(momentTable_LIGHT, 0).xy;
  vec2 lowerInside = clamp(lower, vec2(0.0), vec2(size));
  vec2 upperInside = clamp(upper, vec2(0.0), vec2(size));
  ivec2 begin = ivec2(floor(lowerInside));
  vec2 uncovered = lowerInside - vec2(begin); // share of the first texel
  vec2 covered = fract(upperInside);          // share of the last texel

  ivec2 ends[3];
  ends[0] = min(begin + 1, size);
  ends[1] = ivec2(floor(upperInside));
  ends[2] = min(ends[1] + 1, size);
  vec2 weights[3];
  weights[0] = -uncovered;
  weights[1] = 1.0 - covered;
  weights[2] = covered;

  uvec4 corner = sumBefore_LIGHT(begin, layer);
  uvec4 below[3];
  for (int x = 0; x < 3; ++x)
  {
    below[x] = sumBefore_LIGHT(ivec2(ends[x].x, begin.y), layer) - corner;
  }
  vec4 sum = vec4(0.0);
  for (int y = 0; y < 3; ++y)
  {
    uvec4 left = sumBefore_LIGHT(ivec2(begin.x, ends[y].y), layer);
    for (int x = 0; x < 3; ++x)
    {
      uvec4 units = sumBefore_LIGHT(ivec2(ends[x].x, ends[y].y), layer) - left - below[x];
      sum += weights[x].x * weights[y].y * vec4(ivec4(units));
    }
  }
  vec2 inside = upperInside - lowerInside;
  vec2 whole = upper - lower;
  float area = whole.x * whole.y;
  float areaOutside = area - inside.x * inside.y;
  return (sum / tableUnits_LIGHT + areaOutside * emptyMoments_LIGHT) / area;
}
