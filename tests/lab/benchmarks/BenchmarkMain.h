#pragma once

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

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

/// Add an option for a number in a range.
template <typename Number>
void addNumber(CLI::App& app, const char* name, Number& value, Number least, Number most,
  const std::string& help)
{
  app.add_option(name, value, help)->check(CLI::Range(least, most))->capture_default_str();
}

/// Add an option for texts, separated by commas.
inline CLI::Option* addTexts(
  CLI::App& app, const char* name, std::vector<std::string>& values, const std::string& help)
{
  return app.add_option(name, values, help)->delimiter(',')->capture_default_str();
}

} // namespace gnomon::tool
