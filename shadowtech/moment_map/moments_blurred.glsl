// Look-ups of moments in a map that was blurred with a box of KERNEL_TEXELS_LIGHT texels, and that
// has MOMENT_LEVELS_LIGHT levels.

uniform sampler2DArray momentMap_LIGHT; // linear; its border has the moments of depth 1

#if MOMENT_LEVELS_LIGHT > 1

// The level whose texels make a kernel as wide as what a pixel shows of the receiver: of a width f,
// of which the blur's box has n, sqrt(f^2 - n^2) are left, as widths add up by their squares
// (variance).
float level_LIGHT(ViewPoint point)
{
  float blurred = float(KERNEL_TEXELS_LIGHT * KERNEL_TEXELS_LIGHT);
  float left = max(texelsOfPixel_LIGHT(point) - blurred, 1.0);
  return min(0.5 * log2(left), float(MOMENT_LEVELS_LIGHT - 1));
}

// The width of the kernel along both axes of the map. Beside the box, texels t times as wide as the
// map's add (t^2 - 1) / 12 to its variance, and up to (t^2 - 1) / 4 as the bilinear filter lies
// between two of them: as much as a box's width squared that grows by 4 (t^2 - 1).
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  float level = level_LIGHT(point);
  float finer = floor(level);
  float texelSquared = mix(exp2(2.0 * finer), exp2(2.0 * finer + 2.0), level - finer);
  float blurred = float(KERNEL_TEXELS_LIGHT * KERNEL_TEXELS_LIGHT);
  return vec2(sqrt(blurred + 4.0 * (texelSquared - 1.0)));
}

#else

float level_LIGHT(ViewPoint point)
{
  return 0.0;
}

// The width of the kernel along both axes of the map.
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  return vec2(KERNEL_TEXELS_LIGHT);
}

#endif

// The moments of what a square of the box's width covers around a point: the bilinear filter adds
// the part of a texel that moves it from the middle of its texel (of a box of even width, from that
// texel's lower corner) to the point.
vec4 momentsAt_LIGHT(ViewPoint point)
{
  vec2 place = point.texel + (KERNEL_TEXELS_LIGHT % 2 == 0 ? 0.5 : 0.0);
  return textureLod(
    momentMap_LIGHT, vec3(place / viewSize_LIGHT, float(point.view)), level_LIGHT(point));
}
