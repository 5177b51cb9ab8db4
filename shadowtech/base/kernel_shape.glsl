// The shape of kernels on a map: the twin of lights/KernelShape.h.

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

// Return the shape that is even where the Jacobian comes from and keeps its area, stretched by at
// most a limit.
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
