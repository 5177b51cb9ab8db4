// Finds the plane of each pixel's receiver, from the triangle that VTK drew there
// (ReceiverPlanes.h).

#include "shadowtech/planar/table.glsl"

uniform sampler2D receiverFragments; // x: drawn surface + 1, > 0 if it receives; y: primitive
// x: drawn surface, y: its first primitive, z: index of that in planesOfPrimitives, w: number of
// primitives; in order of x and y.
uniform usampler2D blocks;
uniform int blockCount;
uniform usampler2D planesOfPrimitives; // 0, or 1 + the plane

// 0: receives no shadow; 1: on none of the chosen planes; n + 2: on the n-th plane.
out uint plane;

// Return the entry of planesOfPrimitives for a drawn surface's primitive.
uint planeOf(uint surface, uint primitive)
{
  // Find the last block that begins at or before the primitive.
  int low = 0;
  int high = blockCount;
  while (high - low > 1)
  {
    int middle = (low + high) / 2;
    uvec4 block = tableEntry(blocks, middle);
    bool before = block.x < surface || (block.x == surface && block.y <= primitive);
    low = before ? middle : low;
    high = before ? high : middle;
  }
  uvec4 block = tableEntry(blocks, low);
  bool inside = block.x == surface && primitive >= block.y && primitive - block.y < block.w;
  return inside ? tableEntry(planesOfPrimitives, int(block.z + primitive - block.y)).r : 0u;
}

void main()
{
  vec2 fragment = texelFetch(receiverFragments, ivec2(gl_FragCoord.xy), 0).xy;
  plane = 0u;
  if (fragment.x > 0.0)
  {
    plane = 1u + planeOf(uint(fragment.x) - 1u, uint(fragment.y));
  }
}
