#pragma once

#include <chrono>

namespace gnomon
{

/// The clock that frames are measured by: milliseconds since some moment. It never goes back.
inline double steadyMilliseconds()
{
  return std::chrono::duration<double, std::milli>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

} // namespace gnomon
