// Rays against triangles, without cracks between neighbours.

#ifndef GNOMON_WATERTIGHT
#define GNOMON_WATERTIGHT

// A ray, prepared for tests against triangles. Coordinates are relative to its origin, turned so
// that z is the ray's largest component, and sheared so that the ray follows z (Woop, Benthin,
// Wald: Watertight Ray/Triangle Intersection, JCGT 2013).
struct TriangleRay
{
  vec3 origin;
  vec3 direction;
  vec3 permuted; // the direction, turned
  vec2 shear;
  float far;
  int axis; // which axis became z
};

vec3 turned(vec3 v, int axis) { return axis == 0 ? v.yzx : (axis == 1 ? v.zxy : v); }

TriangleRay triangleRay(vec3 origin, vec3 direction, float far)
{
  vec3 magnitudes = abs(direction);
  int axis = magnitudes.x > magnitudes.y ? 0 : 1;
  axis = magnitudes.z >= max(magnitudes.x, magnitudes.y) ? 2 : axis;
  vec3 permuted = turned(direction, axis);
  return TriangleRay(origin, direction, permuted, permuted.xy / permuted.z, far, axis);
}

// The crossing of a ray's line through a triangle.
struct Crossing
{
  bool inside;
  vec3 weights; // of the corners, times a common factor
  float facing; // > 0: the ray meets the front (counter-clockwise), < 0: the back
};

// a, b, c: corners relative to the origin, turned. Each edge's sign is that of the exact cross
// product of its sheared corners. Neighbours share these corners, so they agree on the sign to the
// bit. Without `precise` a compiler might contract a product and a sum in one place only, and the
// signs would differ.
Crossing crossing(TriangleRay ray, vec3 a, vec3 b, vec3 c)
{
  precise vec2 p = a.xy - ray.shear * a.z;
  precise vec2 q = b.xy - ray.shear * b.z;
  precise vec2 r = c.xy - ray.shear * c.z;
  precise vec3 plus = vec3(r.x * q.y, p.x * r.y, q.x * p.y);
  precise vec3 minus = vec3(r.y * q.x, p.y * r.x, q.y * p.x);
  precise vec3 edges = plus - minus;
  // Rounding keeps the order of products, so the sign is open only if they are equal. In double
  // precision they are exact.
  if (any(equal(edges, vec3(0.0))))
  {
    dvec2 pd = dvec2(p);
    dvec2 qd = dvec2(q);
    dvec2 rd = dvec2(r);
    edges = vec3(rd.x * qd.y - rd.y * qd.x, pd.x * rd.y - pd.y * rd.x, qd.x * pd.y - qd.y * pd.x);
  }
  bool mixed = any(lessThan(edges, vec3(0.0))) && any(greaterThan(edges, vec3(0.0)));
  float sum = edges.x + edges.y + edges.z;
  // Turning keeps the handedness; looking along -z shows the other side. The sum is 0 for a line in
  // the triangle's plane, and NaN if something is not finite.
  return Crossing(!mixed && abs(sum) > 0.0, edges, ray.permuted.z < 0.0 ? -sum : sum);
}

// True if the ray meets the triangle's plane between its origin and its far end.
//
// The sign of the volume of origin and triangle tells on which side the ray starts. ShadowRay.h
// bounds its rounding, and starts shadow rays so far off their own triangle that the sign is right.
// The volume depends on the plane and not on the direction, unlike weighted sums of the corners'
// depths: a plane along two axes gives exact signs. The side from which the ray comes is known
// already, so triangles seen nearly edge-on do not get lost between neighbours. If all corners lie
// on one side of the origin, or of the far end, along z, these depths decide instead: their
// differences are exact.
bool isWithinEnds(
  TriangleRay ray, vec3 a, vec3 b, vec3 c, vec3 normal, vec3 corner, float facing)
{
  vec3 depths = vec3(a.z, b.z, c.z);
  depths = ray.permuted.z < 0.0 ? -depths : depths;
  float end = abs(ray.permuted.z) * ray.far;
  precise float volume = dot(corner, normal);
  precise float volumeOfDirection = dot(ray.direction, normal);
  bool ahead = facing < 0.0 ? volume >= 0.0 : volume <= 0.0;
  ahead = all(greaterThanEqual(depths, vec3(0.0))) ||
    (ahead && any(greaterThanEqual(depths, vec3(0.0))));
  bool before = abs(volume) <= ray.far * abs(volumeOfDirection);
  before = all(lessThanEqual(depths, vec3(end))) ||
    (before && any(lessThanEqual(depths, vec3(end))));
  return ahead && before;
}

// True if a ray meets a triangle, on either side.
// @param crossed where, and on which side
bool triangleIsMet(TriangleRay ray, vec3 a, vec3 b, vec3 c, out Crossing crossed)
{
  vec3 fromA = a - ray.origin;
  vec3 aTurned = turned(fromA, ray.axis);
  vec3 bTurned = turned(b - ray.origin, ray.axis);
  vec3 cTurned = turned(c - ray.origin, ray.axis);
  crossed = crossing(ray, aTurned, bTurned, cTurned);
  vec3 normal = cross(b - a, c - a);
  return crossed.inside &&
    isWithinEnds(ray, aTurned, bTurned, cTurned, normal, fromA, crossed.facing);
}

#endif
