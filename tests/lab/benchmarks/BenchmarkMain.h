#pragma once

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

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

/// Return the command line, without the program's folder.
inline std::string commandOf(int argc, char** argv)
{
  std::string text = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i)
  {
    text += std::string(" ") + argv[i];
  }
  return text;
}

} // namespace gnomon::tool
