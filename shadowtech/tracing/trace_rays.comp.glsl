// Traces shadow rays against the casters. The result is a bit per ray: 1 if a caster blocks it.
//
// INSTANCES, CUTOUTS: the scene has them; STACK: the size of the stack of links; GROUP: rays per
// work group.
//
// The traversal descends to leaves first and then tests triangles, so that neighbouring rays do the
// same at the same time (Aila, Laine: Understanding the Efficiency of Ray Traversal on GPUs, 2009).
// It ends at the first blocker. A ray misses no box that holds a triangle it meets, so the answer
// depends neither on the tree nor on the order.

#include "shadowtech/tracing/bvh.glsl"
#include "shadowtech/tracing/watertight.glsl"
#ifdef CUTOUTS
#include "shadowtech/tracing/cutout_mask.glsl"
#endif

layout(local_size_x = GROUP) in;

struct TracedRay
{
  vec3 origin;
  float far;
  vec3 direction;
  uint pixel;
};

layout(std430, binding = 3) readonly buffer Rays { TracedRay rays[]; };
layout(std430, binding = 4) buffer Blocked { uint blocked[]; }; // all 0 at first

uniform int rayCount;
uniform int root; // the bits of a link
uniform vec3 lowerCentred; // box around all casters
uniform vec3 upperCentred;

#ifdef INSTANCES
struct BvhInstance
{
  vec4 sourceFromCentred[3]; // rows
  vec3 lowerSource;
  uint root;
  vec3 upperSource;
  uint unused;
};
layout(std430, binding = 5) readonly buffer BvhInstances { BvhInstance bvhInstances[]; };
#endif

// Links besides those of the tree: the end of the traversal, the end of an instance, and, with its
// number, an instance to enter. Leaves have enterBit unset.
const uint enterBit = 0x40000000u;
const uint walkEnd = 0xffffffffu;
const uint instanceEnd = 0xfffffffeu;

// A ray in the coordinates of one level.
struct LevelRay
{
  BoxRay boxes;
  TriangleRay triangles;
};

LevelRay levelRay(vec3 origin, vec3 direction, float far, vec3 lower, vec3 upper)
{
  return LevelRay(
    boxRay(origin, direction, far, lower, upper), triangleRay(origin, direction, far));
}

bool blocks(uvec4 record, TriangleRay ray)
{
  Crossing crossed;
  bool met = triangleIsMet(
    ray, positionOf(record.x), positionOf(record.y), positionOf(record.z), crossed);
  bool oneSided = (record.w & oneSidedFlag) != 0u;
  bool mirrored = (record.w & mirroredFlag) != 0u;
  // The ray goes to the light. So it meets the back of a triangle whose front faces the light.
  met = met && (!oneSided || (crossed.facing < 0.0) != mirrored);
#ifdef CUTOUTS
  if (met && (record.w & cutoutFlag) != 0u)
  {
    met = isOnSurface(record.w & numberMask, record.xyz, crossed.weights);
  }
#endif
  return met;
}

#ifdef INSTANCES
// Transform a ray to an instance's source coordinates. Places along its direction stay the same.
LevelRay sourceRay(TracedRay traced, BvhInstance instance)
{
  vec3 origin, direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    vec4 row = instance.sourceFromCentred[axis];
    origin[axis] = dot(row.xyz, traced.origin) + row.w;
    direction[axis] = dot(row.xyz, traced.direction);
  }
  return levelRay(origin, direction, traced.far, instance.lowerSource, instance.upperSource);
}
#endif

bool isBlocked(TracedRay traced)
{
  LevelRay centred =
    levelRay(traced.origin, traced.direction, traced.far, lowerCentred, upperCentred);
  LevelRay ray = centred;
  uint stack[STACK];
  stack[0] = walkEnd;
  int waiting = 1;
  uint link = uint(root);
  for (;;)
  {
    while ((link & leafBit) == 0u)
    {
      BvhNode left = bvhNodes[link];
      BvhNode right = bvhNodes[link + 1u];
      float entryLeft, entryRight;
      bool meetsLeft = meetsBox(ray.boxes, left, entryLeft);
      bool meetsRight = meetsBox(ray.boxes, right, entryRight);
      if (meetsLeft && meetsRight)
      {
        bool leftFirst = entryLeft <= entryRight;
        stack[waiting++] = leftFirst ? right.link : left.link;
        link = leftFirst ? left.link : right.link;
      }
      else
      {
        link = meetsLeft ? left.link : (meetsRight ? right.link : stack[--waiting]);
      }
    }
    if (link == walkEnd)
    {
      return false;
    }
#ifdef INSTANCES
    if (link == instanceEnd)
    {
      ray = centred;
      link = stack[--waiting];
      continue;
    }
    if ((link & enterBit) != 0u)
    {
      BvhInstance instance = bvhInstances[link & numberMask];
      ray = sourceRay(traced, instance);
      stack[waiting++] = instanceEnd;
      link = instance.root;
      continue;
    }
#endif
    for (uint i = firstOf(link); i < endOf(link); ++i)
    {
      uvec4 record = bvhRecords[i];
#ifdef INSTANCES
      if ((record.w & instanceFlag) != 0u)
      {
        stack[waiting++] = leafBit | enterBit | record.x;
        continue;
      }
#endif
      if (blocks(record, ray.triangles))
      {
        return true;
      }
    }
    link = stack[--waiting];
  }
}

// True if a ray has finite numbers and a direction; other rays are not blocked.
bool isSound(TracedRay ray)
{
  const float largest = 3.4028235e38;
  float place = dot(abs(ray.origin), vec3(1.0));
  float way = dot(abs(ray.direction), vec3(1.0));
  return place <= largest && way > 0.0 && way <= largest && ray.far >= 0.0;
}

void main()
{
  int number = int(gl_GlobalInvocationID.x);
  if (number < rayCount && isSound(rays[number]) && isBlocked(rays[number]))
  {
    atomicOr(blocked[number >> 5], 1u << (number & 31));
  }
}
