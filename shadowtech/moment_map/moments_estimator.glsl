// Moment shadow maps (Peters and Klein 2015, "Hamburger 4MSM").

#include "shadowtech/moment_map/moment_map.glsl"

#ifndef GNOMON_HAMBURGER
#define GNOMON_HAMBURGER

// This share of the moments is replaced by those of a wide distribution over [-1, 1]. It exceeds
// rounding, so the matrix below is positive definite (Peters and Klein 2015, section 3.2).
const float momentBias = 3.0e-6;
const vec4 momentsOfBias = vec4(0.0, 0.375, 0.0, 0.375);

// Return the largest share of depths at least as far as `depth`, for these moments. Among
// distributions with four given moments, the one with the least before `depth` consists of that
// depth and two others. These are the roots of c.x + c.y z + c.z z^2, where
//     (1  b1 b2)
//     (b1 b2 b3) c = (1, depth, depth^2)
//     (b2 b3 b4)
// is solved by Cholesky's decomposition L D L^T.
float hamburgerBound(vec4 moments, float depth)
{
  vec4 b = mix(moments, momentsOfBias, momentBias);
  // The bias leaves at least this on the diagonal, except for rounding.
  float least = 0.1 * momentBias;
  float l32d22 = b.z - b.x * b.y;
  float d22 = max(b.y - b.x * b.x, least);
  float l32 = l32d22 / d22;
  float d33 = max(b.w - b.y * b.y - l32d22 * l32, least);

  // L c1 = (1, depth, depth^2); D c2 = c1; L^T c = c2.
  vec3 c;
  c.y = depth - b.x;
  c.z = (depth * depth - b.y - l32 * c.y) / d33;
  c.y = c.y / d22 - l32 * c.z;
  c.x = 1.0 - c.y * b.x - c.z * b.y;

  // Find the larger root first, so that no digits cancel. Where c.z is 0, it is at infinity; a very
  // large root gives the same result.
  float leading = abs(c.z) > 1.0e-6 ? c.z : 1.0e-6;
  float middle = -0.5 * c.y / leading;
  float product = c.x / leading;
  float apart = sqrt(max(middle * middle - product, 0.0));
  float larger = middle + (middle < 0.0 ? -apart : apart);
  float smaller = larger != 0.0 ? product / larger : 0.0;
  float nearer = min(larger, smaller);
  float farther = max(larger, smaller);

  // Sum the weights of depths that lie before the receiver's.
  float hidden;
  if (depth <= nearer)
  {
    hidden = 0.0;
  }
  else if (depth <= farther)
  {
    hidden = (depth * farther - b.x * (depth + farther) + b.y) /
      ((farther - nearer) * (depth - nearer));
  }
  else
  {
    hidden = 1.0 -
      (nearer * farther - b.x * (nearer + farther) + b.y) /
        ((depth - nearer) * (depth - farther));
  }
  return clamp(1.0 - hidden, 0.0, 1.0);
}

#endif

// Return the standard deviation of depths on the receiver's own plane. It covers the kernel's
// texels, the point's place between them (the bilinear filter's two texels), and each texel's
// spread.
float planeDeviation_LIGHT(ViewPoint point)
{
  vec2 texels = kernelTexels_LIGHT(point);
  return length(planeSlope_LIGHT(point) * sqrt((texels * texels - 1.0) / 12.0 + 0.25 + 0.25));
}

float estimate_LIGHT(ViewPoint point, float slack)
{
  float depth = centredDepth_LIGHT(point, slack + planeDeviation_LIGHT(point));
  return withoutBleeding_LIGHT(hamburgerBound(momentsAt_LIGHT(point), depth));
}
