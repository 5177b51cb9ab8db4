// The nearest and the farthest surface of a texel: with GL_MIN as the blend equation, in one pass
// over all casters and both of their sides.

#include "shadowtech/base/cutout.glsl"
#include "shadowtech/montecarlo/layer_depth.glsl"

out vec2 nearAndFar; // p, and -p of the surface's back

void main()
{
  float depth = layerDepth();
  nearAndFar = vec2(depth, -(depth + layerSpan(depth)));
  discardHoles();
}
