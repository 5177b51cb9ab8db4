#pragma once

#include "TestFiles.h"

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace gnomon::tool
{

struct Outcome
{
  bool exited = false; ///< false: a signal ended it
  int code = 0;        ///< exit code, or the signal
  std::string errors;  ///< what it wrote to stderr
  std::string output;  ///< and to stdout
};

/// Run the program in a folder.
/// @param words its arguments, without quotation marks, separated by spaces
/// @param output file for stdout, relative to the folder
inline Outcome run(
  const TestFolder& folder, const std::string& words, const std::string& output = "stdout.txt")
{
  std::string command = "cd " + folder.path() + " && exec " GNOMON_PROGRAM;
  std::istringstream stream(words);
  for (std::string word; stream >> word;)
  {
    command += " '" + word + "'";
  }
  const int status = std::system((command + " > " + output + " 2> stderr.txt").c_str());
  return { WIFEXITED(status), WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status),
    readBytes(folder / "stderr.txt"), readBytes(folder / "stdout.txt") };
}

} // namespace gnomon::tool
