// The map holds linear depth. A directional light's depth is linear as it is; a spot light's is
// replaced here. Both are pushed away from the light by what the caster's slope spans up to a texel's
// border (Nsm.h tells why): the directional map by polygon offset, this one by hand, since polygon
// offset does not act on gl_FragDepth.

#ifdef PERSPECTIVE
in float depthLinear;
#endif

void main()
{
#ifdef PERSPECTIVE
  float slope = max(abs(dFdx(depthLinear)), abs(dFdy(depthLinear)));
  gl_FragDepth = depthLinear + SLOPE_PUSH * slope;
#endif
}
