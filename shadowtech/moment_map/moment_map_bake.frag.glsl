// A texel's moments, of the casters' linear depth (MomentMapTechnique.h). momentsOf() is the
// technique's.

#include "shadowtech/base/cutout.glsl"

in float depthLinear;

out vec4 moments;

void main()
{
  // The texel's depths are taken to be spread by half of what they change by to the next texel
  // (Donnelly and Lauritzen 2006 have that square as their bias). Beside a triangle that ends at the
  // texel's centre, its plane may run past the rays; casters in [-1, 1] spread by 1 at most.
  float spread = length(vec2(dFdx(depthLinear), dFdy(depthLinear)));
  moments = momentsOf(2.0 * clamp(depthLinear, 0.0, 1.0) - 1.0, spread < 1.0 ? spread : 1.0);
#ifdef WRITES_DEPTH
  gl_FragDepth = depthLinear;
#endif
  discardHoles();
}
