#include "Progress.h"

#include <cmath>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
Progress::ErrorBuffer::ErrorBuffer()
  : descriptor_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1))
{
}

//------------------------------------------------------------------------------
Progress::ErrorBuffer::~ErrorBuffer()
{
  close(this->descriptor_);
}

//------------------------------------------------------------------------------
/// Write a letter, unbuffered: lines are short and rare.
int Progress::ErrorBuffer::overflow(int letter)
{
  const char byte = traits_type::to_char_type(letter);
  return write(this->descriptor_, &byte, 1) == 1 ? letter : traits_type::eof();
}

//------------------------------------------------------------------------------
Progress::Progress(std::string step)
  : Progress(std::move(step), nullptr, isatty(STDERR_FILENO) != 0, silence)
{
}

//------------------------------------------------------------------------------
Progress::Progress(std::string step, std::ostream& stream, bool isTerminal, Duration silence)
  : Progress(std::move(step), stream.rdbuf(), isTerminal, silence)
{
}

//------------------------------------------------------------------------------
Progress::Progress(std::string step, std::streambuf* buffer, bool isTerminal, Duration silence)
  : stream_(buffer ? buffer : &this->standardError_)
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
    this->stream_ << "gnomon: " << this->step_;
    if (this->share_)
    {
      this->stream_ << ", " << std::lround(100.0 * *this->share_) << " %";
    }
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(
      std::chrono::steady_clock::now() - this->start_);
    this->stream_ << ", " << seconds.count() << " s" << (this->isTerminal_ ? "" : "\n")
                  << std::flush;
    this->isShown_ = this->isTerminal_;
  }
}

//------------------------------------------------------------------------------
/// Clear the terminal's line.
void Progress::erase()
{
  if (this->isShown_)
  {
    this->stream_ << "\r\x1b[K" << std::flush;
    this->isShown_ = false;
  }
}

} // namespace gnomon::tool
