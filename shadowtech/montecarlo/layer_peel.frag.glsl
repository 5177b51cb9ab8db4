// The nearest surface of a texel behind the one that was peeled off before, of those that face the
// light or of those that face away: a depth test finds it.

#include "shadowtech/base/cutout.glsl"
#include "shadowtech/montecarlo/layer_depth.glsl"

uniform sampler2DArray layers; // x: depth; of what was peeled before
uniform int before;            // its layer; negative: nothing was
uniform int fronts;            // 1: those that face the light

out vec2 depthAndSpan;

void main()
{
  float depth = layerDepth();
  depthAndSpan = vec2(depth, layerSpan(depth));
#ifdef PERSPECTIVE
  gl_FragDepth = depth + 1.0;
#else
  gl_FragDepth = depth;
#endif
  discardHoles();
  bool peeled =
    before >= 0 && depth <= texelFetch(layers, ivec3(gl_FragCoord.xy, before), 0).r;
  if (peeled || gl_FrontFacing != (fronts == 1))
  {
    discard;
  }
}
