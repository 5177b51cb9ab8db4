#pragma once

#include "TestFiles.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

extern char** environ;

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
/// @param output file for stdout, relative to the folder
inline Outcome run(const TestFolder& folder, const std::vector<std::string>& arguments,
  const std::string& output = "stdout.txt")
{
  std::vector<std::string> words = { GNOMON_PROGRAM };
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words)
  {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);

  constexpr int anew = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), anew, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "stderr.txt", anew, 0600);
  pid_t process = 0;
  const int failure =
    posix_spawn(&process, GNOMON_PROGRAM, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
  {
    throw std::runtime_error("the program cannot be started");
  }
  int status = 0;
  waitpid(process, &status, 0);
  return { WIFEXITED(status), WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status),
    readBytes(folder / "stderr.txt"), readBytes(folder / "stdout.txt") };
}

} // namespace gnomon::tool
