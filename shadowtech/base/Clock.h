#pragma once

#include <chrono>

namespace gnomon
{

/// Return the milliseconds since a fixed moment. Times frames, and never goes back.
inline double steadyMilliseconds()
{
  return std::chrono::duration<double, std::milli>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

} // namespace gnomon
