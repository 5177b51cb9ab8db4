// A caster's depth in ray space (RaySpace.h) at the texel's centre, and how far it spans within the
// texel.

in float depthLinear;

#ifdef PERSPECTIVE
uniform float nearest; // the linear depth at which p is -1
#endif

float layerDepth()
{
#ifdef PERSPECTIVE
  // Beside a triangle that ends at the texel's centre, its plane may run to the light and past it.
  return -nearest / max(depthLinear, nearest);
#else
  return depthLinear;
#endif
}

// Behind each surface, what its plane spans over the texel counts as solid: so a sheet has no gaps
// between the texels of a slope. No more than the whole depth, where a triangle stands along the
// light.
float layerSpan(float depth)
{
  return min(abs(dFdx(depth)) + abs(dFdy(depth)), 1.0);
}
