// Returns the mean and the mean square of a depth (Donnelly and Lauritzen 2006).

vec4 momentsOf(float depth, float spread)
{
  return vec4(depth, depth * depth + spread * spread, 0.0, 0.0);
}
