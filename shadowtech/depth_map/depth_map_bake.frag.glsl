// The map holds linear depth, pushed away from the light by what the caster's slope spans within
// the reach of a look-up (DepthMapTechnique.h tells why). A parallel view's depth is linear as it
// is, and polygon offset may push it; else both are done here.
//
// PUSH is how many times that span it is pushed. EUCLIDEAN measures along the ray.
// BEHIND draws what lies behind another map only.

#include "shadowtech/base/cutout.glsl"

#ifdef WRITES_DEPTH

#include "shadowtech/base/caster_map.glsl"

in float depthLinear;

uniform float bias; // on top of what is pushed
#ifdef EUCLIDEAN
uniform float rayScale; // 1 / the longest ray to distance 1 from the light
#endif

#ifdef BEHIND
uniform sampler2DArray frontDepths;
uniform int frontLayer;
#endif

// The support function of the reach.
float span(vec2 slope)
{
  float texels = REACH_SQUARE * (abs(slope.x) + abs(slope.y)) + REACH_DISC * length(slope);
#ifdef KERNEL
#ifdef KERNEL_EVEN
  vec2 slopeKernel = slope * evenShape(texelJacobian(), KERNEL_UNIT);
#else
  vec2 slopeKernel = slope * (KERNEL_UNIT * texelJacobian());
#endif
  texels += KERNEL_SQUARE * (abs(slopeKernel.x) + abs(slopeKernel.y)) +
    KERNEL_DISC * length(slopeKernel);
#endif
  return texels;
}

// How much larger a texel within the reach can be than this one, at most: the slope's own texel of
// difference is within the reach, too. A kernel's shape changes by as much again.
float warp()
{
#ifdef WARPED
  vec3 scales = texelScale();
  float scale = dot(scales, vec3(gl_FragCoord.xy, 1.0));
  float change = span(scales.xy) + abs(scales.x) + abs(scales.y);
  float left = max(1.0 - change / scale, 0.5);
#ifdef KERNEL
  left *= left;
#endif
  return 1.0 / (left * left);
#else
  return 1.0;
#endif
}

float pushed()
{
#ifdef PERSPECTIVE
  // Not the depth is affine across the light, but its inverse. Where it reaches 0, the plane runs
  // past the rays.
  float inverse = 1.0 / depthLinear; // where the light begins, depth is positive
  float left = inverse - PUSH * warp() * span(vec2(dFdx(inverse), dFdy(inverse)));
  return left * DEEPEST > 1.0 ? 1.0 / left : DEEPEST;
#else
  return depthLinear + PUSH * warp() * span(vec2(dFdx(depthLinear), dFdy(depthLinear)));
#endif
}

#endif

void main()
{
#ifdef WRITES_DEPTH
  float depth = min(pushed() + bias, DEEPEST);
#ifdef EUCLIDEAN
  depth *= rayScale * length(vec3(across(), 1.0));
#endif
#ifdef BEHIND
  if (depth <= texelFetch(frontDepths, ivec3(gl_FragCoord.xy, frontLayer), 0).r + BEHIND)
  {
    discard;
  }
#endif
  gl_FragDepth = depth;
#endif
  discardHoles();
}
