// The twin of splitDistances() (lights/Splits.h), of one distance.

float splitDistance(float nearest, float farthest, float share, float lambda)
{
  float uniformSplit = nearest + (farthest - nearest) * share;
  float from = nearest > 0.0 ? nearest : 1e-3 * farthest;
  // Without a positive distance there are no logarithms.
  float logarithmic = farthest > 0.0 ? from * pow(farthest / from, share) : uniformSplit;
  return clamp(mix(uniformSplit, logarithmic, lambda), nearest, farthest);
}
