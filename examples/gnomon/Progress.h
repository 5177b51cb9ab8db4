#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

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
    bool isTerminal = isatty(STDERR_FILENO) != 0, Duration silence = Duration(2000))
    : descriptor_(fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1))
    , isTerminal_(isTerminal)
    , silence_(silence)
    , step_(std::move(step))
    , thread_([this] { this->show(); })
  {
  }

  ~Progress()
  {
    {
      const std::lock_guard<std::mutex> lock(this->mutex_);
      this->isDone_ = true;
      this->erase();
    }
    this->done_.notify_one();
    this->thread_.join();
    close(this->descriptor_);
  }

  Progress& operator=(Progress&&) = delete; ///< nor copied

  /// Begin a step.
  /// @param share finished share of all work, in [0, 1]; none if it is unknown
  void begin(const std::string& step, std::optional<double> share = std::nullopt)
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->step_ = step;
    this->share_ = share;
  }

  /// Write a line that is not progress.
  void print(const std::string& line, std::ostream& stream = std::cerr)
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->erase();
    stream << line << std::endl;
  }

private:
  /// Run the thread: show lines until all work is done.
  void show()
  {
    // A terminal follows each step; a log grows slowly.
    const Duration period = this->isTerminal_ ? this->silence_ / 10 : this->silence_;
    Duration pause = this->silence_;
    std::unique_lock<std::mutex> lock(this->mutex_);
    while (!this->done_.wait_for(lock, pause, [this] { return this->isDone_; }))
    {
      pause = period;
      this->erase();
      const std::string share =
        this->share_ ? ", " + std::to_string(std::lround(100.0 * *this->share_)) + " %" : "";
      const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(
        std::chrono::steady_clock::now() - this->start_);
      dprintf(this->descriptor_, "gnomon: %s%s, %ld s%s", this->step_.c_str(), share.c_str(),
        static_cast<long>(seconds.count()), this->isTerminal_ ? "" : "\n");
      this->isShown_ = this->isTerminal_;
    }
  }

  /// Clear the terminal's line.
  void erase()
  {
    if (this->isShown_)
    {
      dprintf(this->descriptor_, "\r\x1b[K");
      this->isShown_ = false;
    }
  }

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
