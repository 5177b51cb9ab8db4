#include "Progress.h"

#include <cmath>
#include <utility>

#include <fcntl.h>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
Progress::Progress(std::string step, int descriptor, bool isTerminal, Duration silence)
  : descriptor_(fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1))
  , isTerminal_(isTerminal)
  , silence_(silence)
  , step_(std::move(step))
  , thread_([this] { this->show(); })
{
}

//------------------------------------------------------------------------------
Progress::~Progress()
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

//------------------------------------------------------------------------------
void Progress::begin(const std::string& step, std::optional<double> share)
{
  const std::lock_guard<std::mutex> lock(this->mutex_);
  this->step_ = step;
  this->share_ = share;
}

//------------------------------------------------------------------------------
void Progress::print(const std::string& line, std::ostream& stream)
{
  const std::lock_guard<std::mutex> lock(this->mutex_);
  this->erase();
  stream << line << std::endl;
}

//------------------------------------------------------------------------------
/// Run the thread: show lines until all work is done.
void Progress::show()
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

//------------------------------------------------------------------------------
/// Clear the terminal's line.
void Progress::erase()
{
  if (this->isShown_)
  {
    dprintf(this->descriptor_, "\r\x1b[K");
    this->isShown_ = false;
  }
}

} // namespace gnomon::tool
