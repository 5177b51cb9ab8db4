// The map holds linear depth, pushed away from the light by what the caster's slope spans within the
// reach of a look-up (DepthMapTechnique.h tells why). A parallel view's depth is linear as it is, and
// polygon offset may push it; else both are done here.

#ifdef PUSH

in float depthLinear;

// The support function of the reach.
float push(vec2 slope)
{
  return REACH_SQUARE * (abs(slope.x) + abs(slope.y)) + REACH_DISC * length(slope);
}

#endif

#ifdef CUTOUT
in vec2 cutoutCoordinates;

uniform sampler2D cutoutMask; // 0 where the caster has a hole, as the alpha that VTK looks at
#endif

void main()
{
#ifdef PUSH
#ifdef PERSPECTIVE
  // Not the depth is affine on the map, but its inverse. Where it reaches 0, the plane runs past the
  // rays.
  float inverse = 1.0 / depthLinear; // in front of the near plane there are no fragments
  float pushed = inverse - push(vec2(dFdx(inverse), dFdy(inverse)));
  gl_FragDepth = pushed * DEEPEST > 1.0 ? 1.0 / pushed : DEEPEST;
#else
  gl_FragDepth = min(depthLinear + push(vec2(dFdx(depthLinear), dFdy(depthLinear))), DEEPEST);
#endif
#endif
#ifdef CUTOUT
  // At the end, since what comes before takes derivatives.
  if (texture(cutoutMask, cutoutCoordinates).r <= 0.0)
  {
    discard;
  }
#endif
}
