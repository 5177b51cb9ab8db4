// The twin of functions of ShadowRay.h, which documents them. Several lights' sources may include
// it into one shader.

#ifndef GNOMON_SHADOW_RAY
#define GNOMON_SHADOW_RAY

float shadowRayOffset(float noise, float footprint)
{
  return 2.0 * noise + 0.00390625 * footprint; // 1/256
}

bool facesLight(vec3 normal, vec3 toLight)
{
  float cosine = dot(normal, toLight);
  return cosine > 0.0 && cosine * cosine > 9.094947e-13 * dot(toLight, toLight); // 2^-40
}

bool insideCone(vec3 toLight, vec3 axis, float tangentSquared)
{
  float along = dot(toLight, axis);
  vec3 across = toLight - along * axis;
  return along > 0.0 && dot(across, across) <= tangentSquared * (along * along);
}

bool insideBox(vec3 positionLight, vec3 box)
{
  return abs(positionLight.x) <= box.x && abs(positionLight.y) <= box.y && positionLight.z >= 0.0 &&
    positionLight.z <= box.z;
}

#endif
