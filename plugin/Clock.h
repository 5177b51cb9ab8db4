#ifndef gnomon_plugin_Clock_h
#define gnomon_plugin_Clock_h

#include <chrono>

namespace gnomon
{

/// What time it is, in milliseconds since some moment. Who decides by times gets it handed in, so that tests can say it.
using Clock = double (*)();

/// The clock of those who measure frames: it never goes back.
inline double steadyMilliseconds()
{
  return std::chrono::duration<double, std::milli>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

} // namespace gnomon

#endif
