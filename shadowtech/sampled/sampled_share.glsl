// What the map of one point of the light adds to the sum of all points, behind the source of its estimator
// (sampled_sum.frag.glsl, Sampled.h).

uniform vec3 pointOffset_LIGHT; // from the light's centre, in the centre's light space

// Of a receiver that faces the centre. Its normal and the way to the centre are in that light space.
float share_LIGHT(vec3 positionView, vec3 normalView, vec3 normalCentre, vec3 toCentre)
{
  bool faces = facesLight(normalCentre, toCentre + pointOffset_LIGHT);
  bool facesOpposite = facesLight(normalCentre, toCentre - pointOffset_LIGHT);
  if (!faces)
  {
    // The opposite point counts for both. Where rounding denies it both of them, the receiver's plane holds the
    // light, and its own plane is no caster.
    return facesOpposite ? 0.0 : 1.0;
  }
  vec3 p = (lightFromView_LIGHT * vec4(positionView, 1.0)).xyz;
  vec3 n = mat3(lightFromView_LIGHT) * normalView;
  return (facesOpposite ? 1.0 : 2.0) * visibilityOnMap_LIGHT(p, n, positionView, normalView);
}
