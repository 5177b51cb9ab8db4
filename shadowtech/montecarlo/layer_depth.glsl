// A caster's depth in ray space (RaySpace.h) at the texel's centre, and its span within the texel.

in float depthLinear;

#ifdef PERSPECTIVE
uniform float nearest; // the linear depth at which p is -1
#endif

float layerDepth()
{
#ifdef PERSPECTIVE
  // Where a triangle ends at the texel's centre, its plane may extend to the light and beyond.
  return -nearest / max(depthLinear, nearest);
#else
  return depthLinear;
#endif
}

// Return the plane's change of depth over the texel. That much behind each surface counts as solid,
// so a sheet on a slope has no gaps between texels. For triangles along the light it ends at the
// whole depth.
float layerSpan(float depth)
{
  return min(abs(dFdx(depth)) + abs(dFdy(depth)), 1.0);
}
