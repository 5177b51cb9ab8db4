// Writes the nearest and the farthest surface of a texel. The blend equation GL_MIN finds both in
// one pass over both sides of all casters.

#include "shadowtech/base/cutout.glsl"
#include "shadowtech/montecarlo/layer_depth.glsl"

out vec2 nearAndFar; // p, and -p of the surface's back

void main()
{
  float depth = layerDepth();
  nearAndFar = vec2(depth, -(depth + layerSpan(depth)));
  discardHoles();
}
