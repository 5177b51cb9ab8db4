#ifndef GNOMON_CHEBYSHEV
#define GNOMON_CHEBYSHEV

// Return the largest share of values at least as large as `value`, for this mean and variance (not
// 0): Chebyshev's one-sided inequality. Two different values reach it, as where one plane partly
// shadows another.
float chebyshevBound(float mean, float variance, float value)
{
  float beyond = value - mean;
  return beyond <= 0.0 ? 1.0 : variance / (variance + beyond * beyond);
}

#endif
