#pragma once

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <optional>
#include <streambuf>
#include <string>
#include <thread>

namespace gnomon::tool
{

/// Shows the progress of work of more than two seconds, from construction to destruction. On a
/// terminal it rewrites one line; elsewhere it prints a line every two seconds. Other output must
/// go through print(), so lines do not mix.
class Progress
{
public:
  using Duration = std::chrono::milliseconds;
  static constexpr Duration silence{ 2000 }; ///< before the first line

  /// @param step the first step, such as "reading bunny.obj"
  explicit Progress(std::string step);
  /// @param isTerminal true if lines on the stream can be overwritten
  Progress(std::string step, std::ostream& stream, bool isTerminal, Duration silence);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begin a step.
  /// @param share finished share of all work, in [0, 1]; none if it is unknown
  void begin(const std::string& step, std::optional<double> share = std::nullopt);

  /// Write a line that is not progress.
  void print(const std::string& line, std::ostream& stream = std::cerr);

private:
  /// Writes to a copy of standard error, as readGuarded() catches what its descriptor gets.
  class ErrorBuffer : public std::streambuf
  {
  public:
    ErrorBuffer();
    ~ErrorBuffer() override;

  private:
    int overflow(int letter) override;

    const int descriptor_;
  };

  /// @param buffer of the stream; null for standard error
  Progress(std::string step, std::streambuf* buffer, bool isTerminal, Duration silence);
  void show();
  void erase();

  ErrorBuffer standardError_;
  std::ostream stream_;
  const bool isTerminal_;
  const Duration silence_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::mutex mutex_; ///< guards all members below, and the stream
  std::string step_;
  std::optional<double> share_;
  bool isShown_ = false; ///< true while a line is on the terminal
  bool isDone_ = false;
  std::condition_variable done_;
  std::thread thread_; ///< the last member: it reads the others
};

} // namespace gnomon::tool
