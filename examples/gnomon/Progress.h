#pragma once

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace gnomon::tool
{

/// Tells how far work of more than two seconds is, from construction to destruction: by a line that
/// is rewritten on a terminal, elsewhere by a line every two seconds. Other output goes through
/// print() meanwhile, so that no two lines mix.
class Progress
{
public:
  using Duration = std::chrono::milliseconds;
  static constexpr Duration silence{ 2000 }; ///< before the first line

  /// @param step what is done first, such as "reading bunny.obj"
  explicit Progress(std::string step);
  /// @param isTerminal whether lines on the stream can be written over
  Progress(std::string step, std::ostream& stream, bool isTerminal, Duration silence);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What is done now.
  /// @param share how much of all work is done, in [0, 1]; none if that is not known
  void begin(const std::string& step, std::optional<double> share = std::nullopt);

  /// Writes a line of another kind.
  void print(const std::string& line, std::ostream& stream = std::cerr);

private:
  void show();
  void erase();

  std::ostream& stream_;
  const bool isTerminal_;
  const Duration silence_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::mutex mutex_; ///< of all below, and of the stream
  std::string step_;
  std::optional<double> share_;
  bool isShown_ = false; ///< whether a line stands on the terminal
  bool isDone_ = false;
  std::condition_variable done_;
  std::thread thread_; ///< the last member: it reads the others
};

} // namespace gnomon::tool
