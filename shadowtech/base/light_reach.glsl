// Tests whether a light's cone or box contains a point, for shaders that draw all pixels of one
// light (LightViewsGlsl.h). SPOT and BOX select the test.

#include "shadowtech/base/shadow_ray.glsl"

uniform mat4 lightFromView; // rigid: the camera's space to the light's
uniform float lightCone;    // squared tangent of half the cone
uniform vec3 lightBox;      // half width, half height, depth

bool lightReaches(vec3 positionView)
{
#if defined(SPOT) || defined(BOX)
  vec3 positionLight = (lightFromView * vec4(positionView, 1.0)).xyz;
#endif
#if defined(SPOT)
  return insideCone(-positionLight, vec3(0.0, 0.0, -1.0), lightCone);
#elif defined(BOX)
  return insideBox(positionLight, lightBox);
#else
  return true;
#endif
}
