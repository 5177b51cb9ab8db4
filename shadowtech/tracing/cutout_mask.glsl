// Holes of casters' textures for ray tracing: the twin of CutoutMask.cpp, on masks in a buffer.
// Samplers would filter with rounded weights, and OpenGL has few of them.

#ifndef GNOMON_CUTOUT_MASK
#define GNOMON_CUTOUT_MASK

// For each surface with holes, five numbers from GpuTracer.cpp: the place of its texture
// coordinates minus its first vertex; the place of its mask; how to read the mask; width; height.
// All masks follow, a bit per texel.
layout(std430, binding = 6) readonly buffer Cutouts { uint cutouts[]; };
layout(std430, binding = 7) readonly buffer TextureCoordinates { vec2 textureCoordinates[]; };

const uint numbersOfCutout = 5u;

const int wrapClampToEdge = 0;
const int wrapRepeat = 1;
const int wrapMirroredRepeat = 2;
const int wrapClampToBorder = 3;

struct CutoutMask
{
  uint coordinates; // plus a vertex: index of its texture coordinates
  uint firstBit;    // of cutouts
  int wrap;
  bool interpolated;
  bool borderDrawn;
  ivec2 size;
};

CutoutMask cutoutMask(uint number)
{
  uint i = numbersOfCutout * number;
  uint reading = cutouts[i + 2u];
  return CutoutMask(cutouts[i], 32u * cutouts[i + 1u], int(reading & 3u), (reading & 4u) != 0u,
    (reading & 8u) != 0u, ivec2(cutouts[i + 3u], cutouts[i + 4u]));
}

// Wrap a coordinate into [0, 1], or [-1, 2] if there is a border.
float reduced(float coordinate, int wrap)
{
  float folded = coordinate - 2.0 * floor(0.5 * coordinate);
  float result = wrap == wrapClampToEdge ? clamp(coordinate, 0.0, 1.0)
    : wrap == wrapRepeat                 ? coordinate - floor(coordinate)
    : wrap == wrapMirroredRepeat         ? min(folded, 2.0 - folded)
                                         : clamp(coordinate, -1.0, 2.0);
  return result >= -1.0 && result <= 2.0 ? result : 0.0; // not finite
}

// True if the texel at indices that are out of range by no more than the size has alpha above 0.
bool texelDrawn(CutoutMask mask, ivec2 texel)
{
  bvec2 outside =
    bvec2(texel.x < 0 || texel.x >= mask.size.x, texel.y < 0 || texel.y >= mask.size.y);
  ivec2 place = mask.wrap == wrapRepeat ? (texel + mask.size) % mask.size
                                        : clamp(texel, ivec2(0), mask.size - 1);
  uint bit = mask.firstBit + uint(place.y * mask.size.x + place.x);
  bool drawn = ((cutouts[bit >> 5] >> (bit & 31u)) & 1u) != 0u;
  return mask.wrap == wrapClampToBorder && any(outside) ? mask.borderDrawn : drawn;
}

bool isDrawn(CutoutMask mask, vec2 coordinates)
{
  vec2 place =
    vec2(reduced(coordinates.x, mask.wrap), reduced(coordinates.y, mask.wrap)) * vec2(mask.size);
  if (!mask.interpolated)
  {
    return texelDrawn(mask, ivec2(floor(place)));
  }
  vec2 fromCentre = place - 0.5;
  vec2 firstTexel = floor(fromCentre);
  ivec2 texel = ivec2(firstTexel);
  bool nextColumn = fromCentre.x > firstTexel.x;
  bool nextRow = fromCentre.y > firstTexel.y;
  return texelDrawn(mask, texel) || (nextColumn && texelDrawn(mask, texel + ivec2(1, 0))) ||
    (nextRow && texelDrawn(mask, texel + ivec2(0, 1))) ||
    (nextColumn && nextRow && texelDrawn(mask, texel + ivec2(1, 1)));
}

// True if a point of a triangle lies on the surface and not in a hole.
// @param corners indices into all positions
// @param weights of the corners, times a common factor other than 0
bool isOnSurface(uint number, uvec3 corners, vec3 weights)
{
  CutoutMask mask = cutoutMask(number);
  vec2 a = textureCoordinates[corners.x + mask.coordinates];
  vec2 b = textureCoordinates[corners.y + mask.coordinates];
  vec2 c = textureCoordinates[corners.z + mask.coordinates];
  vec3 shares = weights / (weights.x + weights.y + weights.z);
  return isDrawn(mask, a + shares.y * (b - a) + shares.z * (c - a));
}

#endif
