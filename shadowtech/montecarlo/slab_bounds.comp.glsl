// Builds a level of the pyramid over the slabs (SlabBounds.h): level 0 from the slabs, with
// OF_BOUNDS another one from the level below.

#include "shadowtech/montecarlo/slabs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray below; // the slabs, or the pyramid
uniform int layer;            // of `below`
uniform int level;            // of the mip map to read
layout(binding = 0, rgba32f) writeonly uniform image2D target;

// x: the least depth at which a slab begins; y: the greatest at which one ends; z, w: the greatest
// begin and the least end of the thickest slab of each texel.
vec4 joined(vec4 a, vec4 b)
{
  return vec4(min(a.x, b.x), max(a.y, b.y), max(a.z, b.z), min(a.w, b.w));
}

#ifndef OF_BOUNDS
vec4 boundsOfTexel(ivec2 texel)
{
  vec4 bounds = vec4(2.0, -2.0, 2.0, -2.0);
  if (any(greaterThanEqual(texel, textureSize(below, 0).xy)))
  {
    return bounds; // beyond a map whose side is no power of two
  }
  for (int i = 0; i < 2 * PAGES; ++i)
  {
    vec4 page = texelFetch(below, ivec3(texel, layer + i / 2), 0);
    vec2 slab = vec2(1.0, -1.0) * (i % 2 == 0 ? page.xy : page.zw);
    bounds.xy = vec2(min(bounds.x, slab.x), max(bounds.y, slab.y));
    bounds.zw = slab.y - slab.x > bounds.w - bounds.z ? slab : bounds.zw;
  }
  return bounds;
}
#endif

void main()
{
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(target))))
  {
    return;
  }
#ifndef OF_BOUNDS
  vec4 bounds = boundsOfTexel(texel);
#else
  ivec2 first = 2 * texel;
  ivec2 second = first + 1;
  vec4 bounds = joined(joined(texelFetch(below, ivec3(first, layer), level),
                         texelFetch(below, ivec3(second.x, first.y, layer), level)),
    joined(texelFetch(below, ivec3(first.x, second.y, layer), level),
      texelFetch(below, ivec3(second, layer), level)));
#endif
  imageStore(target, texel, bounds);
}
