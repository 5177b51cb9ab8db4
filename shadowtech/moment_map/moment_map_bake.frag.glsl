// A texel's moments, of the casters' linear depth (MomentMapTechnique.h). momentsOf() is the
// technique's. SAMPLES is how many a texel is drawn with; each has its own depth.

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
  // The texel's depths are taken to be spread by half of what they change by to the next texel
  // (Donnelly and Lauritzen 2006 have that square as their bias), a sample's by as much less as its
  // part of the texel is narrower. Beside a triangle that ends at the texel's centre, its plane may
  // run past the rays; casters in [-1, 1] spread by 1 at most.
  float spread = length(vec2(dFdx(depth), dFdy(depth))) / sqrt(float(SAMPLES));
  moments = momentsOf(2.0 * clamp(depth, 0.0, 1.0) - 1.0, spread < 1.0 ? spread : 1.0);
#ifdef WRITES_DEPTH
  gl_FragDepth = depth;
#endif
  discardHoles();
}
