// Boxes around points, which many invocations grow at once (ViewBounds).

// The least of six numbers, box after box: x, y, z, -x, -y, -z, as keys.
layout(std430, binding = 0) buffer Boxes { uint leastKeys[]; };

// Return a float's key: an unsigned integer of the same order. keyOfNone is the key of no float.
const uint keyOfNone = 0xffffffffu;
uint keyOf(float value)
{
  uint bits = floatBitsToUint(value);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
// Return the float of a key; infinite for keyOfNone.
float ofKey(uint key)
{
  uint bits = min(key, 0xff800000u);
  return uintBitsToFloat((bits & 0x80000000u) != 0u ? bits & 0x7fffffffu : ~bits);
}

void growBox(int box, vec3 lower, vec3 upper)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    atomicMin(leastKeys[6 * box + axis], keyOf(lower[axis]));
    atomicMin(leastKeys[6 * box + 3 + axis], keyOf(-upper[axis]));
  }
}

bool isEmpty(int box)
{
  return leastKeys[6 * box] == keyOfNone;
}
vec3 lowerOf(int box)
{
  return vec3(
    ofKey(leastKeys[6 * box]), ofKey(leastKeys[6 * box + 1]), ofKey(leastKeys[6 * box + 2]));
}
vec3 upperOf(int box)
{
  return -vec3(
    ofKey(leastKeys[6 * box + 3]), ofKey(leastKeys[6 * box + 4]), ofKey(leastKeys[6 * box + 5]));
}
