#include "Runner.h"

#include "Cases.h"
#include "Files.h"
#include "TestFiles.h"
#include "VtkMessages.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace gnomon::fuzz
{
namespace
{

/// The memory limit of a child; no good case needs as much.
constexpr rlim_t mostBytes = rlim_t(8) << 30;

/// Cases of a child. Software OpenGL leaks some memory with each context.
constexpr unsigned mostCases = 100;

double secondsNow()
{
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

void send(int pipe, const std::string& text)
{
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof(length), '\0');
  std::memcpy(bytes.data(), &length, sizeof(length));
  bytes += text;
  for (std::size_t sent = 0; sent < bytes.size();)
  {
    const ssize_t written = ::write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (written <= 0)
    {
      _exit(1); // the parent has ended
    }
    sent += static_cast<std::size_t>(written);
  }
}

/// A process that runs cases one by one and sends the error of each.
class Child
{
public:
  /// @param folder for temporary files
  Child(const CaseKind& kind, Place place, const std::string& folder)
  {
    int ends[2];
    if (::pipe(ends) != 0 || (this->process_ = ::fork()) < 0)
    {
      throw std::runtime_error("no process can be started");
    }
    if (this->process_ == 0)
    {
      ::close(ends[0]);
      ::setenv("TMPDIR", folder.c_str(), 1);
#ifndef __SANITIZE_ADDRESS__ // which reserves terabytes of addresses
      const rlimit limit{ mostBytes, mostBytes };
      ::setrlimit(RLIMIT_AS, &limit);
#endif
      for (;; ++place.index)
      {
        send(ends[1], whatIsWrong(kind, place));
      }
    }
    ::close(ends[1]);
    this->pipe_ = ends[0];
  }

  /// Kill the process; ending it takes as long as a case does.
  ~Child()
  {
    ::close(this->pipe_);
    ::kill(this->process_, SIGKILL);
    ::waitpid(this->process_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Wait for the next case.
  /// @param wrong set to the case's error; empty if there is none
  /// @return false if the process can run no more cases
  bool finish(double seconds, std::string& wrong)
  {
    std::uint32_t length = 0;
    const double end = secondsNow() + seconds;
    bool isThere = this->receive(&length, sizeof(length), end);
    wrong.resize(length);
    isThere = isThere && this->receive(wrong.data(), length, end);
    if (!isThere)
    {
      wrong = this->whyItStopped(seconds);
    }
    return isThere;
  }

private:
  bool receive(void* bytes, std::size_t count, double end)
  {
    for (std::size_t received = 0; received < count;)
    {
      pollfd wait{ this->pipe_, POLLIN, 0 };
      if (::poll(&wait, 1, std::max(0, static_cast<int>(1000.0 * (end - secondsNow())))) <= 0)
      {
        this->hangs_ = true;
        return false;
      }
      const ssize_t read =
        ::read(this->pipe_, static_cast<char*>(bytes) + received, count - received);
      if (read <= 0)
      {
        return false;
      }
      received += static_cast<std::size_t>(read);
    }
    return true;
  }

  std::string whyItStopped(double seconds)
  {
    if (this->hangs_)
    {
      return "it takes more than " + std::to_string(static_cast<int>(seconds)) + " s\n";
    }
    siginfo_t state{};
    ::waitid(P_PID, static_cast<id_t>(this->process_), &state, WEXITED | WNOWAIT);
    return state.si_code == CLD_EXITED
      ? "it ends the process with exit code " + std::to_string(state.si_status) + "\n"
      : std::string("it crashes: ") + ::strsignal(state.si_status) + "\n";
  }

  pid_t process_ = 0;
  int pipe_ = 0;
  bool hangs_ = false;
};

} // namespace

unsigned run(const CaseKind& kind, const Run& run)
{
  const double end = run.seconds > 0.0 ? secondsNow() + run.seconds : 0.0;
  const tool::TestFolder temporary; // also for files that crashed cases leave behind
  std::unique_ptr<Child> child;
  unsigned finds = 0;
  unsigned done = 0;
  for (; done < run.count && (end == 0.0 || secondsNow() < end); ++done)
  {
    const Place place{ run.first.seed, run.first.index + done };
    if (!child)
    {
      child = std::make_unique<Child>(kind, place, temporary.path());
    }
    std::string wrong;
    if (!child->finish(run.secondsPerCase, wrong) || done % mostCases == mostCases - 1)
    {
      child.reset();
    }
    if (wrong.empty())
    {
      continue;
    }
    ++finds;
    const std::string name = kind.name + " --seed " + std::to_string(place.seed) + " --first " +
      std::to_string(place.index) + " --count 1";
    std::cout << "gnomon_fuzz " << name << "\n" << wrong << std::endl;
    if (!run.folder.empty())
    {
      std::filesystem::create_directories(run.folder);
      tool::writeWholeFile(run.folder + "/" + kind.name + "-" + std::to_string(place.seed) + "-" +
          std::to_string(place.index) + ".txt",
        name + "\n" + wrong);
    }
  }
  std::cout << kind.name << ": " << done << " cases, " << finds << " finds" << std::endl;
  return finds;
}

const std::vector<CaseKind>& caseKinds()
{
  static const std::vector<CaseKind> kinds = {
    { "scenes", "scenes, lights, cameras and settings, against rays and VTK alone", runScene },
    { "sequences", "changes of scenes, against a fresh pass in a fresh window", runSequence },
    { "files", "broken scene files, models and images, which `gnomon render` draws or refuses",
      runFile }
  };
  return kinds;
}

std::string whatIsWrong(const CaseKind& kind, const Place& place)
{
  std::seed_seq seeds{ place.seed, place.index };
  std::string description;
  const tool::VtkMessages messages;
  try
  {
    kind.run(Random(seeds), description);
    if (messages.errors().empty() && messages.warnings().empty())
    {
      return "";
    }
    const auto& texts = messages.errors().empty() ? messages.warnings() : messages.errors();
    return "VTK says: " + texts.front() + "\n" + description;
  }
  catch (const std::exception& error)
  {
    return std::string(error.what()) + "\n" + description;
  }
}

} // namespace gnomon::fuzz
