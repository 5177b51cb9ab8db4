// Random points of an area light, one in each cell of a grid of RAYS x RAYS. The twin of
// LightSamples with `light_sampling` jittered (lights/LightSamples.h), to within rounding. SHAPE is
// LightArea's.

#include "shadowtech/montecarlo/reduced_md5.glsl"

#define RECTANGLE 0
#define DISK 1
#define BALL 2

// From the shape of half side or radius 1 to the light's, in view coordinates.
uniform mat3 viewFromUnit;
uniform int lightSeed;

// The concentric map from the square of half side 1 to the unit disk (Shirley and Chiu 1997).
vec2 diskPoint(vec2 square)
{
  bool wide = abs(square.x) > abs(square.y);
  float radius = wide ? square.x : square.y;
  float other = wide ? square.y : square.x;
  // The square's middle maps to the disk's.
  float angle = radius == 0.0 ? 0.0 : 0.7853981634 * (other / radius);
  vec2 point = radius * vec2(cos(angle), sin(angle));
  return wide ? point : point.yx;
}

// The hashes of four points of a pixel: their places in their cells, and for a ball their heights
// (HashedPoints.h).
struct FourPoints
{
  uvec4 across;
  uvec4 along;
};
FourPoints fourPoints(ivec2 pixel, int number)
{
  uvec4 seed = uvec4(uvec2(pixel), uint(number / 4), 0u);
  FourPoints points;
  points.across = reducedMd5(seed, uint(lightSeed));
#if SHAPE == BALL
  points.along = reducedMd5(points.across, uint(lightSeed));
#else
  points.along = uvec4(0u);
#endif
  return points;
}

// Return one of the points, relative to the light's centre.
vec3 lightPoint(FourPoints points, int number)
{
  uint across = points.across[number % 4];
  vec2 cell = vec2(number % RAYS, number / RAYS % RAYS);
  vec2 inCell = vec2(across & 0xffffu, across >> 16) / 65536.0;
  vec2 square = 2.0 * (cell + inCell) / float(RAYS) - 1.0;
#if SHAPE == RECTANGLE
  return viewFromUnit * vec3(square, 0.0);
#else
  vec2 disk = diskPoint(square);
#if SHAPE == DISK
  return viewFromUnit * vec3(disk, 0.0);
#else
  float height = sqrt(max(1.0 - dot(disk, disk), 0.0));
  float turn = 3.1415926536 * (0.5 - float(points.along[number % 4] >> 8) * 5.9604645e-8);
  return viewFromUnit * vec3(disk, height * sin(turn));
#endif
#endif
}
