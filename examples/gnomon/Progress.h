#pragma once

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <unistd.h>

namespace gnomon::tool
{

/// Shows the progress of work of more than two seconds, from construction to destruction. On a
/// terminal it rewrites one line; elsewhere it prints a line every two seconds. Other output must
/// go through print(), so lines do not mix.
class Progress
{
public:
  using Duration = std::chrono::milliseconds;

  /// @param step the first step, such as "reading bunny.obj"
  /// @param descriptor of the file for lines; a copy is written to, as readGuarded() catches what
  /// standard error gets
  /// @param silence before the first line
  explicit Progress(std::string step, int descriptor = STDERR_FILENO,
    bool isTerminal = isatty(STDERR_FILENO) != 0, Duration silence = Duration(2000));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begin a step.
  /// @param share finished share of all work, in [0, 1]; none if it is unknown
  void begin(const std::string& step, std::optional<double> share = std::nullopt);

  /// Write a line that is not progress.
  void print(const std::string& line, std::ostream& stream = std::cerr);

private:
  void show();
  void erase();

  const int descriptor_;
  const bool isTerminal_;
  const Duration silence_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::mutex mutex_; ///< guards all members below, and the file
  std::string step_;
  std::optional<double> share_;
  bool isShown_ = false; ///< true while a line is on the terminal
  bool isDone_ = false;
  std::condition_variable done_;
  std::thread thread_; ///< the last member: it reads the others
};

} // namespace gnomon::tool
