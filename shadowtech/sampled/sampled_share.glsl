// What the map of one point of the light adds to the sum of all points, behind the source of its
// estimator (sampled_sum.frag.glsl, Sampled.h).

#include "shadowtech/base/shine.glsl"

uniform vec3 pointOffset_LIGHT; // from the light's centre, in the centre's light space
#ifdef TEXTURED
uniform vec3 pointShine_LIGHT;
#else
#define pointShine_LIGHT 1.0
#endif

// Of a receiver that faces the centre. Its normal and the way to the centre are in that light
// space.
Shine share_LIGHT(vec3 positionView, vec3 normalView, vec3 normalCentre, vec3 toCentre)
{
  bool faces = facesLight(normalCentre, toCentre + pointOffset_LIGHT);
  bool facesOpposite = facesLight(normalCentre, toCentre - pointOffset_LIGHT);
  if (!faces)
  {
    // The opposite point counts for both. Where rounding denies it both of them, the receiver's
    // plane holds the light, and its own plane is no caster.
    return facesOpposite ? Shine(0.0) : pointShine_LIGHT;
  }
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  float counts = facesOpposite ? 1.0 : 2.0;
  return counts * visibilityOnMap_LIGHT(p, n, positionView, normalView) * pointShine_LIGHT;
}
