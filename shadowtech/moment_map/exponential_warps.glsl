#ifndef GNOMON_EXPONENTIAL_WARPS
#define GNOMON_EXPONENTIAL_WARPS

// For depths in [-1, 1]; the twin of MomentEstimators.h.
const float exponentPositive = 40.0;
const float exponentNegative = 5.0;

#endif
