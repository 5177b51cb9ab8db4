// Cells of seven minima each, by atomic operations on bits in the order of the numbers. A maximum
// is stored as the minimum of the negative.
//
// The order of minima does not matter, so cells equal the CPU's (TexelCells.h) to the last bit.
// Climb and noise of undecided texels are an exception, and nothing reads these.

const uint numbersOfCell = 7u;
const uint nearestInCell = 0u;
const uint containedInCell = 1u;
const uint sharpEndInCell = 2u;
const uint firstInCell = 3u;
const uint secondInCell = 4u;
const uint climbInCell = 5u; // negative
const uint noiseInCell = 6u; // negative

const float infinity = uintBitsToFloat(0x7f800000u);

layout(std430, binding = 3) buffer Cells { uint cells[]; };

uniform int firstRow; // of the map, at which the cells begin

uint orderedBits(float number)
{
  uint bits = floatBitsToUint(number);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float numberOf(uint ordered)
{
  return uintBitsToFloat((ordered & 0x80000000u) != 0u ? ordered & 0x7fffffffu : ~ordered);
}

uint cellAt(int x, int y)
{
  return numbersOfCell * (uint(y - firstRow) * uint(width) + uint(x));
}

// Cells only ever decrease, so comparing with an old value saves most atomic operations.
void lowerBits(uint at, uint bits)
{
  if (bits < cells[at])
  {
    atomicMin(cells[at], bits);
  }
}

void lower(uint at, float number)
{
  lowerBits(at, orderedBits(number));
}

// Return the depth up to which there is one layer, if any (Cell of TexelCells.h). All casters must
// be rasterized.
float oneLayerUpTo(uint cell)
{
  precise float climb = max(0.0, -numberOf(cells[cell + climbInCell]));
  precise float upTo =
    numberOf(min(cells[cell + secondInCell], cells[cell + sharpEndInCell])) - climb;
  return upTo;
}

// Keep the two least depths. Each depth ends up as the first, or is compared with the second when
// it or a depth that it displaced meets a smaller one. So the second is the least of all others.
// Equal depths count twice.
void addLayer(uint cell, float depth)
{
  uint bits = orderedBits(depth);
  if (bits < cells[cell + secondInCell])
  {
    uint before = atomicMin(cells[cell + firstInCell], bits);
    lowerBits(cell + secondInCell, max(before, bits));
  }
}
