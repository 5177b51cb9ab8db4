// The minima of all texels by atomic operations: small triangles by an invocation each, and with LARGE the others,
// which that has put into a list, by work groups.

layout(local_size_x = GROUP) in;

// Two minima of each texel, row by row, as bits that are ordered as the numbers are.
layout(std430, binding = 2) buffer Texels { uint minima[]; };
layout(std430, binding = 3) buffer Large
{
  uint largeCount;
  uint largeTriangles[];
};

uniform int triangleCount;

// More texels than this are worth a work group.
const int mostTexels = 1024;

uint orderedBits(float number)
{
  uint bits = floatBitsToUint(number);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

// Texels only ever become less, so that a look at an old value saves most of the atomic operations.
void lower(uint at, float number)
{
  uint bits = orderedBits(number);
  if (bits < minima[at])
  {
    atomicMin(minima[at], bits);
  }
}

void draw(Cover cover, ivec2 texel)
{
  vec2 bounds = boundsIn(cover, vec2(texel) + 0.5 - 0.5 * size);
  if (bounds.x < infinity)
  {
    uint at = 2u * (uint(texel.y) * uint(size) + uint(texel.x));
    lower(at, bounds.x);
    if (bounds.y < infinity)
    {
      lower(at + 1u, bounds.y);
    }
  }
}

void main()
{
#ifdef LARGE
  for (uint i = gl_WorkGroupID.x; i < largeCount; i += gl_NumWorkGroups.x)
  {
    Cover cover = coverOfTriangle(largeTriangles[i]);
    Rectangle box = boxOf(cover);
    ivec2 first = ivec2(ceil(box.low + (0.5 * size - 0.5)));
    ivec2 last = ivec2(floor(box.high + (0.5 * size - 0.5)));
    for (int y = first.y + int(gl_WorkGroupID.y); y <= last.y; y += int(gl_NumWorkGroups.y))
    {
      for (int x = first.x + int(gl_LocalInvocationID.x); x <= last.x; x += GROUP)
      {
        draw(cover, ivec2(x, y));
      }
    }
  }
#else
  uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= uint(triangleCount))
  {
    return;
  }
  Cover cover = coverOfTriangle(triangle);
  Rectangle box = boxOf(cover);
  ivec2 first = ivec2(ceil(box.low + (0.5 * size - 0.5)));
  ivec2 last = ivec2(floor(box.high + (0.5 * size - 0.5)));
  ivec2 texels = max(last - first + 1, ivec2(0));
  if (texels.x * texels.y > mostTexels)
  {
    largeTriangles[atomicAdd(largeCount, 1u)] = triangle;
    return;
  }
  for (int y = first.y; y <= last.y; ++y)
  {
    for (int x = first.x; x <= last.x; ++x)
    {
      draw(cover, ivec2(x, y));
    }
  }
#endif
}
