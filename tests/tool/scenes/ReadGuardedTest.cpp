#include "ReadGuarded.h"

#include "../TestFiles.h"
#include "Errors.h"

#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <sys/resource.h>

#include <cstdio>
#include <new>
#include <thread>

namespace gnomon::tool
{
namespace
{

volatile int zero = 0;

int recurse(int depth)
{
  volatile char page[4096];
  page[depth % 4096] = static_cast<char>(depth);
  return depth < 0 ? 0 : recurse(depth + 1) + page[(depth + 1) % 4096];
}

void inThread(const std::function<void()>& work)
{
  std::thread(work).join();
}

struct Ending
{
  const char* name;
  std::function<void()> read;
};

void PrintTo(const Ending& ending, std::ostream* stream)
{
  *stream << ending.name;
}

class ReadersEnd : public ::testing::TestWithParam<Ending>
{
};

TEST_P(ReadersEnd, AsOneLineAndExitCodeTwo)
{
  const auto read = []
  { readGuarded("outer.obj", 100, [] { readGuarded("damaged.vtp", 100, GetParam().read); }); };
  // All that it writes is that line.
  EXPECT_EXIT(read(), ::testing::ExitedWithCode(badInputCode),
    "^gnomon: error: damaged.vtp: the file is damaged[^\n]*\n$");
}

INSTANTIATE_TEST_SUITE_P(Tool, ReadersEnd,
  ::testing::Values(Ending{ "segmentation", [] { raise(SIGSEGV); } },
    Ending{ "division", [] { zero = 7 / zero; } }, //
    Ending{ "bus", [] { raise(SIGBUS); } },        //
    Ending{ "abort", [] { std::abort(); } },
    Ending{ "freedTwice",
      []
      {
        void* volatile memory = std::malloc(2000);
        std::free(memory);
        std::free(memory);
      } },
    Ending{ "recursion", [] { recurse(0); } }, //
    Ending{ "endlessLoop",
      []
      {
        for (;;)
        {
          zero = 0;
        }
      } },
    Ending{ "crashOfAThread", [] { inThread([] { raise(SIGSEGV); }); } },
    Ending{ "exceptionOfAThread", [] { inThread([] { throw std::bad_alloc(); }); } },
    Ending{ "chatter",
      []
      {
        for (;;)
        {
          std::fprintf(stderr, "unexpected end of file\n");
        }
      } }),
  [](const ::testing::TestParamInfo<Ending>& ending) { return ending.param.name; });

TEST(ReadGuarded, RefusesWhatAReaderThrowsAndPrints)
{
  const auto messageFor = [](const std::function<void()>& read)
  { return messageOf<BadInput>([&] { readGuarded("m.ply", 100, read); }); };
  EXPECT_EQ(messageFor([] { throw BadInput("no"); }), "m.ply: no");
  EXPECT_EQ(messageFor([] { throw BadInput("m.ply: line 3"); }), "m.ply: line 3");
  EXPECT_EQ(messageFor([] { vtkGenericWarningMacro("ignored"); }), "(nothing was thrown)");
  EXPECT_EQ(messageFor([] { std::fprintf(stderr, "Warning: odd\n"); }), "(nothing was thrown)");
  EXPECT_EQ(messageFor([] { std::fprintf(stderr, "Warning: odd\nlost\n"); }), "m.ply: lost");
  // Counts that the file cannot hold.
  const std::string damaged = "m.ply: the file is damaged";
  EXPECT_EQ(messageFor([] { vtkNew<vtkFloatArray>()->SetNumberOfTuples(vtkIdType(1) << 34); })
              .rfind(damaged, 0),
    0u);
}

TEST(ReadGuarded, LeavesTheProcessAsItWas)
{
  rlimit before;
  getrlimit(RLIMIT_DATA, &before);
  readGuarded("m.ply", 100, [] {});
  rlimit after;
  getrlimit(RLIMIT_DATA, &after);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
  EXPECT_EXIT(raise(SIGFPE), ::testing::KilledBySignal(SIGFPE), "");
  EXPECT_EXIT(std::abort(), ::testing::KilledBySignal(SIGABRT), "");
  testing::internal::CaptureStderr();
  std::fprintf(stderr, "heard");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "heard");
}

} // namespace
} // namespace gnomon::tool
