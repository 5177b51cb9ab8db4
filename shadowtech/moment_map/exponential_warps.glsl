#ifndef GNOMON_EXPONENTIAL_WARPS
#define GNOMON_EXPONENTIAL_WARPS

// Of depths in [-1, 1]; a twin of MomentEstimators.h.
const float exponentPositive = 40.0;
const float exponentNegative = 5.0;

#endif
