// The inline route's declarations where a pixel has several samples. A triangle that covers some of
// them need not cover the pixel's centre, and beyond its edge its plane runs on behind its
// neighbours: the point to ask for is the centroid of the covered samples.

// The centroid in view coordinates: where its ray meets the triangle's plane, which the centre and
// the normal give. The first argument is what VTK interpolates there. On most drivers that is the
// centroid already. llvmpipe divides it by the centre's depth, which moves it along the ray; and a
// mapper may have moved the centre (impostors). Where the plane holds the ray (a triangle seen
// exactly edge-on) the centre stands in.
vec3 gnomonCentroid(
  vec3 centroidView, vec3 centreView, vec3 normalView, bool parallelProjection)
{
  vec3 ray = parallelProjection ? vec3(0.0, 0.0, 1.0) : centroidView;
  float along = dot(normalView, ray);
  return along != 0.0
    ? centroidView + ray * (dot(normalView, centreView - centroidView) / along)
    : centreView;
}
