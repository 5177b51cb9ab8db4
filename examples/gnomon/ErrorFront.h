#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::tool
{

/// The error and time of one way to render shadows.
struct ErrorAndTime
{
  double error = 0.0;
  double time = 0.0;
};

/// Return the Pareto front: the ways that no other way beats. A way beats another if it is faster
/// and no more wrong, or less wrong and no slower. Errors count as equal up to 2 %.
/// @return their indices, in order of time; the first of equal ways
std::vector<std::size_t> paretoFront(const std::vector<ErrorAndTime>& ways);

} // namespace gnomon::tool
