#include "ReadGuarded.h"

#include "Errors.h"
#include "Text.h"
#include "VtkMessages.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <thread>

namespace gnomon::tool
{

namespace
{

const std::string damaged =
  "the file is damaged: its reader crashed, ran out of memory or did not end";

// For the signal handler: the innermost guard's line, and the program's standard error.
std::atomic<const std::string*> lineOfGuard = nullptr;
std::atomic<int> standardError = STDERR_FILENO;

/// End the program, with async-signal-safe calls alone.
extern "C" void endProgram(int)
{
  static std::atomic_flag isEnding = ATOMIC_FLAG_INIT;
  while (isEnding.test_and_set())
  {
    pause(); // another thread writes the line
  }
  const std::string* const line = lineOfGuard;
  (void)!write(standardError, line->data(), line->size());
  _exit(badInputCode);
}

/// Return the bytes of the process that RLIMIT_DATA limits.
rlim_t dataBytes()
{
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  for (int field = 0; field < 6; ++field)
  {
    statm >> pages;
  }
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Catches signals and standard error, and limits memory and processor time, from construction to
/// destruction. VTK's PLY reader, libpng and the C library print errors themselves, without end for
/// some files.
class Guard
{
public:
  Guard(const std::string& path, std::size_t bytes)
    : line_("gnomon: error: " + oneLine(path) + ": " + damaged + "\n")
  {
    if (::pipe2(this->pipe_.data(), O_CLOEXEC | O_NONBLOCK) != 0) // a full pipe drops the rest
    {
      throw std::system_error(errno, std::generic_category());
    }
    ::dup2(this->pipe_[1], STDERR_FILENO);
    if (!this->outerLine_)
    {
      standardError = this->errorsBefore_;
    }
    lineOfGuard = &this->line_;

    // Only this thread recurses as deep as the file says. Others use their own stacks.
    alignas(16) static std::array<char, 65536> handlerStack;
    const stack_t stack{ handlerStack.data(), 0, handlerStack.size() };
    sigaltstack(&stack, &this->stack_);
    struct sigaction action = {};
    action.sa_handler = endProgram;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < caught.size(); ++i)
    {
      sigaction(caught[i], &action, &this->actions_[i]);
    }
    std::set_terminate(std::abort); // the default one writes lines of its own
    this->limitMemory(bytes);
    this->limitTime(bytes);
  }

  ~Guard()
  {
    timer_delete(this->timer_);
    setrlimit(RLIMIT_DATA, &this->memory_);
    std::set_terminate(this->terminate_);
    for (std::size_t i = 0; i < caught.size(); ++i)
    {
      sigaction(caught[i], &this->actions_[i], nullptr);
    }
    sigaltstack(&this->stack_, nullptr);
    lineOfGuard = this->outerLine_;
    ::dup2(this->errorsBefore_, STDERR_FILENO);
    for (const int handle : { this->pipe_[0], this->pipe_[1], this->errorsBefore_ })
    {
      ::close(handle);
    }
  }
  Guard& operator=(Guard&&) = delete; ///< nor copied

  /// Return the first printed line that is not a warning; empty if there is none.
  std::string firstError() const
  {
    std::string text(1 << 16, '\0');
    const ssize_t count = ::read(this->pipe_[0], text.data(), text.size());
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    for (const std::string& written : split(text, '\n'))
    {
      if (!written.empty() && written.find("arning") == std::string::npos)
      {
        return written;
      }
    }
    return "";
  }

private:
  /// Make a count that a file of this size cannot hold a std::bad_alloc.
  void limitMemory(std::size_t bytes)
  {
    constexpr rlim_t bytesPerByte = 10000; // no compression reaches it
    constexpr rlim_t mebibyte = 1 << 20;
    const rlim_t base = 1024 * mebibyte + 32 * mebibyte * std::thread::hardware_concurrency();
    getrlimit(RLIMIT_DATA, &this->memory_);
    rlimit memory = this->memory_;
    memory.rlim_cur =
      std::min(memory.rlim_cur, dataBytes() + base + bytesPerByte * static_cast<rlim_t>(bytes));
    setrlimit(RLIMIT_DATA, &memory);
  }

  /// Bound this thread's processor time, so other programs and slow disks do not count.
  void limitTime(std::size_t bytes)
  {
    constexpr std::size_t baseSeconds = 5;
    constexpr std::size_t bytesPerSecond = 100000; // VTK reads .vtp of LZMA 190 times as fast
    sigevent event = {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGPROF;
    timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &this->timer_);
    itimerspec time = {};
    time.it_value.tv_sec = static_cast<time_t>(baseSeconds + bytes / bytesPerSecond);
    timer_settime(this->timer_, 0, &time, nullptr);
  }

  static constexpr std::array<int, 5> caught{ { SIGSEGV, SIGFPE, SIGBUS, SIGABRT, SIGPROF } };

  const std::string line_;
  // The process before.
  const std::string* const outerLine_ = lineOfGuard; ///< null: this guard is the outermost
  const int errorsBefore_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  std::array<int, 2> pipe_{};
  stack_t stack_{};
  std::array<struct sigaction, caught.size()> actions_{};
  const std::terminate_handler terminate_ = std::get_terminate();
  rlimit memory_{};
  timer_t timer_{};
};

} // namespace

std::vector<std::string> readGuarded(
  const std::string& path, std::size_t bytes, const std::function<void()>& read)
{
  const Guard guard(path, bytes);
  const VtkMessages messages;
  std::string error;
  try
  {
    read();
  }
  catch (const std::bad_alloc&)
  {
    error = damaged;
  }
  catch (const std::exception& thrown)
  {
    error = thrown.what();
  }
  if (error.empty() && !messages.errors().empty())
  {
    error = messages.errors().front();
  }
  if (error.empty())
  {
    error = guard.firstError();
  }
  if (!error.empty())
  {
    const bool isNamed = error.compare(0, path.size(), path) == 0;
    throw BadInput(isNamed ? error : path + ": " + error);
  }
  return messages.warnings();
}

} // namespace gnomon::tool
