#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::tool
{

/// How wrong and how slow one way to draw shadows is.
struct ErrorAndTime
{
  double error = 0.0;
  double time = 0.0;
};

/// The ways that no other one beats, by being faster and no more wrong, or less wrong and no
/// slower: the Pareto front. Errors count as equal up to 2 %.
/// @return their numbers, in order of time; of equal ones the first
std::vector<std::size_t> paretoFront(const std::vector<ErrorAndTime>& ways);

} // namespace gnomon::tool
