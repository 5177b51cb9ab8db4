// Lookups of moments in a map blurred by a box of KERNEL_TEXELS_LIGHT texels. The map has
// MOMENT_LEVELS_LIGHT levels.

uniform sampler2DArray momentMap_LIGHT; // linear; its border has the moments of depth 1

#if MOMENT_LEVELS_LIGHT > 1

// Return the level at which the kernel is as wide as the part of the receiver in a pixel. Squares
// of widths add up (variances). So of a width f, the blur's box covers n, and sqrt(f^2 - n^2) is
// left for the level.
float level_LIGHT(ViewPoint point)
{
  float blurred = float(KERNEL_TEXELS_LIGHT * KERNEL_TEXELS_LIGHT);
  float left = max(texelsOfPixel_LIGHT(point) - blurred, 1.0);
  return min(0.5 * log2(left), float(MOMENT_LEVELS_LIGHT - 1));
}

// Return the width of the kernel along both axes of the map. Texels t times as wide as the map's
// add (t^2 - 1) / 12 to the box's variance. The bilinear filter between two of them adds up to (t^2
// - 1) / 4. Together that equals a squared box width that grows by 4 (t^2 - 1).
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

// Return the width of the kernel along both axes of the map.
vec2 kernelTexels_LIGHT(ViewPoint point)
{
  return vec2(KERNEL_TEXELS_LIGHT);
}

#endif

// Return the moments over a square of the box's width around a point. The bilinear filter moves the
// square to the point. The square starts at the middle of the point's texel, or for boxes of even
// width at that texel's lower corner.
vec4 momentsAt_LIGHT(ViewPoint point)
{
  vec2 place = point.texel + (KERNEL_TEXELS_LIGHT % 2 == 0 ? 0.5 : 0.0);
  return textureLod(
    momentMap_LIGHT, vec3(place / viewSize_LIGHT, float(point.view)), level_LIGHT(point));
}
