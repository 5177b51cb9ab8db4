// Adds one point of the light to the sum. The source of the point's estimator comes first
// (sampled_sum.frag.glsl, Sampled.h).

#include "shadowtech/base/shine.glsl"

uniform vec3 pointOffset_LIGHT; // from the light's centre, in the centre's light space
#ifdef TEXTURED
uniform vec3 pointShine_LIGHT;
#else
#define pointShine_LIGHT 1.0
#endif

// Return the contribution for a receiver that faces the centre. `normalCentre` and `toCentre` are
// in the centre's light space.
Shine share_LIGHT(vec3 positionView, vec3 normalView, vec3 normalCentre, vec3 toCentre)
{
  bool faces = facesLight(normalCentre, toCentre + pointOffset_LIGHT);
  bool facesOpposite = facesLight(normalCentre, toCentre - pointOffset_LIGHT);
  if (!faces)
  {
    // The opposite point counts for both. If rounding excludes both points, the receiver's plane
    // holds the light, and does not hide it.
    return facesOpposite ? Shine(0.0) : pointShine_LIGHT;
  }
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  float counts = facesOpposite ? 1.0 : 2.0;
  return counts * visibilityOnMap_LIGHT(p, n, positionView, normalView) * pointShine_LIGHT;
}
