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

#ifdef WARPED

uniform vec3 texelScale; // a texel's size across the light is this, times (texel, 1), squared

#ifdef FITTED

uniform sampler2D viewFits; // at (view, 1): texel = xy * texel before the fit + zw
uniform int view;

// texelScale is for texels before the fit.
vec3 texelScaleOnMap()
{
  vec4 fit = texelFetch(viewFits, ivec2(view, 1), 0);
  vec2 slope = texelScale.xy / fit.xy; // not 0 where anything is drawn
  return vec3(slope, texelScale.z - dot(slope, fit.zw));
}

#else

vec3 texelScaleOnMap()
{
  return texelScale;
}

#endif

// How much larger a texel within the reach can be than this one, at most: the slope's own texel of
// difference is within the reach, too.
float warp()
{
  vec3 onMap = texelScaleOnMap();
  float scale = dot(onMap, vec3(gl_FragCoord.xy, 1.0));
  float change = push(onMap.xy) + abs(onMap.x) + abs(onMap.y);
  float left = max(1.0 - change / scale, 0.5);
  return 1.0 / (left * left);
}

#else

float warp()
{
  return 1.0;
}

#endif

#endif

void main()
{
#ifdef PUSH
#ifdef PERSPECTIVE
  // Not the depth is affine across the light, but its inverse. Where it reaches 0, the plane runs past
  // the rays.
  float inverse = 1.0 / depthLinear; // where the light begins, depth is positive
  float pushed = inverse - warp() * push(vec2(dFdx(inverse), dFdy(inverse)));
  gl_FragDepth = pushed * DEEPEST > 1.0 ? 1.0 / pushed : DEEPEST;
#else
  gl_FragDepth =
    min(depthLinear + warp() * push(vec2(dFdx(depthLinear), dFdy(depthLinear))), DEEPEST);
#endif
#endif
}
