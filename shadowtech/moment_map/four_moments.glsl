// Returns the mean first four powers of two depths, `spread` to either side of the given one.

vec4 momentsOf(float depth, float spread)
{
  float square = depth * depth;
  float variance = spread * spread;
  return vec4(depth, square + variance, depth * (square + 3.0 * variance),
    square * (square + 6.0 * variance) + variance * variance);
}
