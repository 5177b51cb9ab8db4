// What is gathered of texels: seven minima of each, by atomic operations on bits that are ordered
// as the numbers are. Of what is the most somewhere, they hold the least of the negative. As minima
// do not depend on the order, the cells are those of the CPU (TexelCells.h), to the last bit, but
// for G and noise of spoilt texels, for which nothing asks.

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

uniform int firstRow; // of the map, that the cells begin with

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

// Cells only ever become less, so that a look at an old value saves most of the atomic operations.
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

// Up to what depth there is one layer, if any (Cell of TexelCells.h): when all of that is drawn.
float oneLayerUpTo(uint cell)
{
  precise float climb = max(0.0, -numberOf(cells[cell + climbInCell]));
  precise float upTo =
    numberOf(min(cells[cell + secondInCell], cells[cell + sharpEndInCell])) - climb;
  return upTo;
}

// The two least of all. Whatever comes is in the end either the first, or was taken for the second
// when it, or what it gave way to, met a smaller one: so the second is the least of all others, and
// one that comes twice counts twice.
void addLayer(uint cell, float depth)
{
  uint bits = orderedBits(depth);
  if (bits < cells[cell + secondInCell])
  {
    uint before = atomicMin(cells[cell + firstInCell], bits);
    lowerBits(cell + secondInCell, max(before, bits));
  }
}
