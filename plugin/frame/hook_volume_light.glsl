// One light's additions to VTK's shaders of volumes.

// Return a light's visibility from a place without a surface: it faces the light.
float gnomonVisibilityAt_LIGHT(vec3 positionView)
{
  vec3 toLight = toLight_LIGHT((lightFromView_LIGHT * vec4(positionView, 1.0)).xyz);
  return visibility_LIGHT(positionView, transpose(mat3(lightFromView_LIGHT)) * toLight);
}
