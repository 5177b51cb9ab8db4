// Writes the nearest surface behind the one peeled last, among those that face the light or those
// that face away. The depth test finds it.

#include "shadowtech/base/cutout.glsl"
#include "shadowtech/montecarlo/layer_depth.glsl"

uniform sampler2DArray layers; // x: depth, for the surfaces peeled so far
uniform int before;            // layer of the surface peeled last; negative if none is
uniform int fronts;            // 1 for surfaces that face the light

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
