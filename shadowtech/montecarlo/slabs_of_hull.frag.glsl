// Writes one slab per texel: from the nearest to the farthest surface, or (ENDLESS) from the
// nearest one on.

#include "shadowtech/montecarlo/slabs.glsl"

uniform sampler2DArray layers; // nearAndFar of layer_hull.frag.glsl

out vec4 slabs;

void main()
{
  vec2 hull = texelFetch(layers, ivec3(gl_FragCoord.xy, 0), 0).rg;
  bool empty = hull.x > 1.0;
#ifdef ENDLESS
  float end = 2.0;
#else
  float end = -hull.y;
#endif
  slabs = vec4(empty ? NO_SLAB : vec2(hull.x, end), NO_SLAB);
}
