#ifndef GNOMON_CHEBYSHEV
#define GNOMON_CHEBYSHEV

// The largest share of values with this mean and variance (not 0) that can be as large as `value`:
// the one-sided inequality of Chebyshev. It is reached by values of which that share is all the
// same, and the rest is, too: a plane that another one shadows in part.
float chebyshevBound(float mean, float variance, float value)
{
  float beyond = value - mean;
  return beyond <= 0.0 ? 1.0 : variance / (variance + beyond * beyond);
}

#endif
