/// @file
/// main() of all test programs. A program runs many cases. If one crashes or hangs, GoogleTest
/// prints nothing under --gtest_brief, so this main() names the case.
/// The variables GNOMON_TEST_TIER and GNOMON_SLOW_CASES choose cases (QuickTier.h).

#include "QuickTier.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

#include <unistd.h>

namespace
{

constexpr unsigned int secondsPerCase = 300;

std::array<char, 1024> running{}; ///< the case's name; a signal handler must not read a std::string

void write(const char* text)
{
  const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(written); // there is no other output for an error
}

extern "C" void nameTheCase(int signal)
{
  write(signal == SIGALRM ? "\n[  FAILED  ] ran for 300 s: " : "\n[  FAILED  ] crashed: ");
  write(running.data());
  write("\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

class Watch : public testing::EmptyTestEventListener
{
  void OnTestStart(const testing::TestInfo& test) override
  {
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::strncpy(running.data(), name.c_str(), running.size() - 1);
    alarm(secondsPerCase);
  }
  void OnTestEnd(const testing::TestInfo& /*test*/) override { alarm(0); }
};

/// Return a variable of the environment; empty if it is not set.
std::string environment(const char* name)
{
  const char* const value = std::getenv(name);
  return value ? value : "";
}

} // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  GTEST_FLAG_SET(filter,
    gnomon::test::filterOfTier(
      environment("GNOMON_TEST_TIER"), environment("GNOMON_SLOW_CASES"), GTEST_FLAG_GET(filter)));
  testing::UnitTest::GetInstance()->listeners().Append(new Watch); // GoogleTest deletes it
  for (const int signal : { SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
  {
    const auto previous = std::signal(signal, nameTheCase);
    if (previous != SIG_DFL)
    {
      std::signal(signal, previous); // a sanitizer's handler, which reports more
    }
  }
  return RUN_ALL_TESTS();
}
