// The shape of kernels on a map.

#ifndef GNOMON_KERNEL_SHAPE
#define GNOMON_KERNEL_SHAPE

// Return the derivative of a homography's image at a place. w > 0 there.
mat2 homographyJacobian(mat3 homography, vec2 at)
{
  vec3 image = homography * vec3(at, 1.0);
  vec2 place = image.xy / image.z;
  return mat2(homography[0].xy - place * homography[0].z,
           homography[1].xy - place * homography[1].z) /
    image.z;
}

// Return the shape that is even where the Jacobian J comes from and keeps its area. It is
// J / sqrt(det J), with singular values s (the stretch) and 1 / s. If s exceeds the limit, which is
// at least 1, the result stretches by the limit along the same axes.
//
// The Jacobian is the sum of a scaled rotation and a scaled reflection, whose scales are half the
// sum and half the difference of its singular values. The limit changes these two numbers only.
// @param jacobian not 0, its determinant not negative; 0 means an infinite stretch
mat2 evenShape(mat2 jacobian, float largestStretch)
{
  vec2 turn = 0.5 * vec2(jacobian[0].x + jacobian[1].y, jacobian[0].y - jacobian[1].x);
  vec2 mirror = 0.5 * vec2(jacobian[0].x - jacobian[1].y, jacobian[0].y + jacobian[1].x);
  float turned = length(turn);
  float mirrored = length(mirror);
  float least = max(turned - mirrored, 1e-6 * turned);
  float stretch = min(sqrt((turned + mirrored) / least), largestStretch);
  turn *= 0.5 * (stretch + 1.0 / stretch) / turned;
  mirror *= mirrored > 0.0 ? 0.5 * (stretch - 1.0 / stretch) / mirrored : 0.0;
  return mat2(turn + mirror, mirror.y - turn.y, turn.x - mirror.x);
}

#endif
