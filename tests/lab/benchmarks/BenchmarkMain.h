#pragma once

#include <exception>
#include <iostream>

namespace gnomon::tool
{

/// Run a benchmark program to its exit code. An exception's message goes to the error output.
template <typename Run>
int runBenchmark(const char* name, const Run& run)
{
  try
  {
    return run();
  }
  catch (const std::exception& error)
  {
    std::cerr << name << ": error: " << error.what() << "\n";
    return 1;
  }
}

} // namespace gnomon::tool
