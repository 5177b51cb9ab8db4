// Writes the map's depth: linear, and pushed away from the light by the span of the caster's slope
// within the reach of a look-up (DepthMapTechnique.h gives the reason). A parallel view's depth is
// linear already, and polygon offset may push it. Else this shader does both.
//
// PUSH: how many times that span it pushes. EUCLIDEAN: measures along the ray. BEHIND: draws only
// what lies behind another map.

#include "shadowtech/base/cutout.glsl"

#ifdef WRITES_DEPTH

#include "shadowtech/base/caster_map.glsl"

in float depthLinear;

uniform float bias; // added to the push
#ifdef EUCLIDEAN
uniform float rayScale; // 1 / the longest ray to distance 1 from the light
#endif

#ifdef BEHIND
uniform sampler2DArray frontDepths;
uniform int frontLayer;
#endif

// Return the support function of the reach for a slope.
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

// Return how much larger a texel within the reach is than this one, at most. The texel over which
// the slope is a difference counts as within the reach. A kernel's shape changes by as much again.
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
  // The inverse of depth is affine across the light, not depth. Where it reaches 0, the plane
  // extends past the rays.
  float inverse = 1.0 / depthLinear; // depth is positive from the light's start on
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
