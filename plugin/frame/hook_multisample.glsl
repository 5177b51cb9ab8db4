// The inline route's declarations for pixels with several samples. A triangle that covers some of
// them may not cover the pixel's centre, and its plane continues behind its neighbours. So
// visibility is asked at the centroid of the covered samples.

// Return the centroid in view coordinates: where its ray meets the triangle's plane, which is given
// by the centre and the normal. The first argument is VTK's interpolation at the centroid. Most
// drivers return the centroid. llvmpipe divides it by the centre's depth, which moves it along the
// ray. Also, a mapper may have moved the centre (impostors). If the plane contains the ray (a
// triangle seen exactly edge-on), return the centre.
vec3 gnomonCentroid(vec3 centroidView, vec3 centreView, vec3 normalView)
{
  vec3 ray = gnomonToCamera(centroidView);
  float along = dot(normalView, ray);
  return along != 0.0
    ? centroidView + ray * (dot(normalView, centreView - centroidView) / along)
    : centreView;
}
