#pragma once

#include "FrameVariant.h"

#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace gnomon::test
{

/// In milliseconds.
struct Time
{
  double wall;
  /// CPU time of all threads. It tells more than wall time on a busy machine with software OpenGL.
  double processor;
};

/// Return the times since fixed moments.
inline Time now()
{
  const auto millisecondsOf = [](clockid_t clock)
  {
    timespec time;
    clock_gettime(clock, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  return { millisecondsOf(CLOCK_MONOTONIC), millisecondsOf(CLOCK_PROCESS_CPUTIME_ID) };
}

/// One of the ways that take turns.
struct Way
{
  std::string name;
  std::function<void()> run;
  std::vector<double> wall = {};
  std::vector<double> processor = {};

  Time medians() const { return { tool::median(this->wall), tool::median(this->processor) }; }
};

/// Time all ways in turn.
inline void takeTurns(std::vector<Way>& ways, int repetitions)
{
  for (int repetition = 0; repetition <= repetitions; ++repetition)
  {
    for (Way& way : ways)
    {
      const Time begin = now();
      way.run();
      const Time end = now();
      if (repetition > 0) // the first one builds programs
      {
        way.wall.push_back(end.wall - begin.wall);
        way.processor.push_back(end.processor - begin.processor);
      }
    }
  }
}

/// Print each way's times, and their ratio to the first way's.
/// @param first the first way's short name
inline void printTimes(const std::vector<Way>& ways, const std::string& first)
{
  const std::string perFirst = "x " + first;
  std::cout << std::fixed << std::setprecision(2) << std::setw(34) << "ms" << std::setw(10)
            << perFirst << std::setw(16) << "processor ms" << std::setw(10) << perFirst << "\n";
  const Time base = ways.front().medians();
  for (const Way& way : ways)
  {
    const Time time = way.medians();
    std::cout << std::left << std::setw(24) << way.name << std::right << std::setw(10) << time.wall
              << std::setw(10) << time.wall / base.wall << std::setw(16) << time.processor
              << std::setw(10) << time.processor / base.processor << "\n";
  }
  std::cout << std::flush;
}

} // namespace gnomon::test
