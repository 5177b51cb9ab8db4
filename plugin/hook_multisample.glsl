// The inline route's declarations where a pixel has several samples. A triangle that covers some of
// them need not cover the pixel's centre, and beyond its edge its plane runs on behind its neighbours:
// the point to ask for is the centroid of the covered samples.

// The centroid in view coordinates. Some drivers (llvmpipe) interpolate there but divide by the
// centre's depth, which moves the point along its ray and off the triangle; the triangle's plane, by
// its normal and the centre, takes it back. Where the plane holds the ray (a triangle seen exactly
// edge-on) they do not meet; the centre stands in.
vec3 gnomonCentroid(vec3 centreView, vec3 normalView, bool parallelProjection)
{
  vec3 centroidView = interpolateAtCentroid(vertexVCVSOutput).xyz;
  if (parallelProjection)
  {
    return centroidView; // nothing was divided
  }
  float along = dot(normalView, centroidView);
  return along != 0.0 ? centroidView * (dot(normalView, centreView) / along) : centreView;
}
