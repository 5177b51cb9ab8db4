// One light's additions to VTK's shaders of volumes.

// Return the normal of a place without a surface: it faces the light.
vec3 gnomonNormalAt_LIGHT(vec3 positionView)
{
  vec3 toLight = toLight_LIGHT((lightFromView_LIGHT * vec4(positionView, 1.0)).xyz);
  return transpose(mat3(lightFromView_LIGHT)) * toLight;
}
