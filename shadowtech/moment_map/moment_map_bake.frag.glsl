// Writes a texel's moments of the casters' linear depth (MomentMapTechnique.h). The technique
// defines momentsOf(). SAMPLES is the number of samples per texel; each has its own depth.

#include "shadowtech/base/cutout.glsl"

in float depthLinear;

out vec4 moments;

void main()
{
#if SAMPLES > 1
  float depth = interpolateAtSample(depthLinear, gl_SampleID);
#else
  float depth = depthLinear;
#endif
  // A texel's depths count as spread by half of their change to the next texel; Donnelly and
  // Lauritzen 2006 use that square as their bias. A sample's spread is smaller, like its part of
  // the texel. Where a triangle ends at the texel's centre, its plane may extend past the rays.
  // Casters in [-1, 1] spread by 1 at most.
  float spread = length(vec2(dFdx(depth), dFdy(depth))) / sqrt(float(SAMPLES));
  moments = momentsOf(2.0 * clamp(depth, 0.0, 1.0) - 1.0, spread < 1.0 ? spread : 1.0);
#ifdef WRITES_DEPTH
  gl_FragDepth = depth;
#endif
  discardHoles();
}
