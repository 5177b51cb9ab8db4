// On which plane each pixel's receiver lies, from the triangle that VTK drew there
// (ReceiverPlanes.h).

#include "shadowtech/planar/table.glsl"

uniform sampler2D receiverFragments; // x: the drawn surface + 1, > 0 if it receives; y: the primitive
uniform usampler2D blocks;           // x: drawn surface, y: its first primitive, z: where that is in
                                     // planesOfPrimitives, w: how many follow; in order of x and y
uniform int blockCount;
uniform usampler2D planesOfPrimitives; // 0, or 1 + the plane

out uint plane; // 0: shows no shadow at all; 1: lies on no plane that is served; n + 2: on the n-th

// The plane of a drawn surface's primitive, as planesOfPrimitives says it.
uint planeOf(uint surface, uint primitive)
{
  // The last block that begins at or before the primitive.
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
