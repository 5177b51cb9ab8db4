// The casters' bounding volume hierarchy, and rays against its boxes. CasterBvh.h documents the
// layout.

#ifndef GNOMON_BVH
#define GNOMON_BVH

struct BvhNode
{
  vec3 lower;
  uint link;
  vec3 upper;
  uint unused;
};

layout(std430, binding = 0) readonly buffer BvhNodes { BvhNode bvhNodes[]; };
layout(std430, binding = 1) readonly buffer BvhRecords { uvec4 bvhRecords[]; };
layout(std430, binding = 2) readonly buffer Positions { float positions[]; }; // three each

const uint leafBit = 0x80000000u;
const uint countShift = 28u;
const uint firstMask = 0x0fffffffu;

const uint instanceFlag = 0x80000000u;
const uint oneSidedFlag = 0x40000000u;
const uint mirroredFlag = 0x20000000u;
const uint cutoutFlag = 0x10000000u;
const uint numberMask = 0x0fffffffu;

uint firstOf(uint link) { return link & firstMask; }
uint endOf(uint link) { return firstOf(link) + ((link >> countShift) & 3u) + 1u; }

vec3 positionOf(uint vertex)
{
  uint i = 3u * vertex;
  return vec3(positions[i], positions[i + 1u], positions[i + 2u]);
}

// A ray, prepared for tests against boxes.
struct BoxRay
{
  vec3 inverse;     // of the direction
  vec3 fromOfLower; // origin, raised so that lower sides keep below all rounding
  vec3 fromOfUpper;
  float far;
};

// A ray must never miss a box that holds a triangle it meets: only then does every tree give
// the answer of all triangles. Boxes allow for these errors, with u = 2^-24:
//
// - triangleIsMet() (watertight.glsl) takes corners relative to the origin, shears and rounds them.
//   Along one axis this costs u |A| for the first rounding, on that and on A_z; 5u |A_z| for a
//   shear whose division is off by 2.5 units in the last place (as much as GLSL allows); u |A_z|
//   for its product with A_z; and u (|A| + |A_z|) for the difference. Together that is at most 10u
//   of the corner's largest coordinate relative to the origin. The tested triangle lies as near to
//   the true one, so boxes grow by as much on all sides.
// - Moving the origin instead of the box rounds once more, u of the coordinate itself.
// - An instance's box has to allow for rays in source coordinates (imageBounds(), CasterBvh.cpp).
//
// The distances to the sides are off by a rounding of the difference, one of the product and 5u of
// the inverse: 7u. So near and far ends are compared with 16u between them (Ize, Robust BVH Ray
// Traversal, 2013, eq. 8).
#ifdef INSTANCES
const float boxSlack = 7.6293945e-6; // 2^-17
#else
const float boxSlack = 9.5367432e-7; // 2^-20
#endif
const float farSlack = 1.00000095; // 1 + 2^-20

// A zero component of a direction would divide by zero, and zero times infinity is no number. It is
// replaced by one so small that the ray is off by less than 2^-60 of its way.
const float smallestShare = 8.6736174e-19; // 2^-60

float largestOf(vec3 v)
{
  vec3 magnitudes = abs(v);
  return max(magnitudes.x, max(magnitudes.y, magnitudes.z));
}

// lower, upper: the box around everything that the ray may meet
BoxRay boxRay(vec3 origin, vec3 direction, float far, vec3 lower, vec3 upper)
{
  float least = smallestShare * largestOf(direction);
  vec3 away = mix(vec3(least), vec3(-least), lessThan(direction, vec3(0.0)));
  vec3 safe = mix(direction, away, lessThan(abs(direction), vec3(least)));
  float reach = max(largestOf(lower - origin), largestOf(upper - origin));
  float slack = boxSlack * (reach + largestOf(origin));
  return BoxRay(1.0 / safe, origin + slack, origin - slack, far);
}

// True if a ray may meet the contents of a box. entry: where along its direction it enters.
bool meetsBox(BoxRay ray, BvhNode node, out float entry)
{
  vec3 toLower = (node.lower - ray.fromOfLower) * ray.inverse;
  vec3 toUpper = (node.upper - ray.fromOfUpper) * ray.inverse;
  vec3 near = min(toLower, toUpper);
  vec3 far = max(toLower, toUpper);
  entry = max(max(near.x, near.y), max(near.z, 0.0));
  return entry <= farSlack * min(min(far.x, far.y), min(far.z, ray.far));
}

#endif
