// Writes the slab from the nearest to the farthest surface of a texel, or (ENDLESS) from the
// nearest one on. The blend equation GL_MIN finds both in one pass over both sides of all casters.

#include "shadowtech/base/cutout.glsl"
#include "shadowtech/montecarlo/layer_depth.glsl"
#include "shadowtech/montecarlo/slabs.glsl"

out vec4 page;

void main()
{
  float depth = layerDepth();
#ifdef ENDLESS
  float end = 2.0;
#else
  float end = depth + layerSpan(depth);
#endif
  page = vec4(depth, -end, NO_SLAB);
  discardHoles();
}
