#include "Progress.h"

#include "TestFiles.h"

#include <gmock/gmock.h>

#include <fcntl.h>

namespace gnomon::tool
{
namespace
{

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::MatchesRegex;

/// Return the messages of work of 200 ms: a busy machine may wake its thread late.
std::string said(bool isTerminal, milliseconds silence)
{
  const TestFolder folder;
  const std::string path = folder / "said";
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  {
    std::ofstream stream(path, std::ios::app);
    Progress progress("reading", file, isTerminal, silence);
    progress.begin("rendering", 0.4);
    std::this_thread::sleep_for(milliseconds(200));
    progress.print("a note", stream);
  }
  close(file);
  return readBytes(path);
}

TEST(Progress, IsSilentAboutShortWork)
{
  EXPECT_EQ(said(false, milliseconds(10000)), "a note\n");
  EXPECT_EQ(said(true, milliseconds(10000)), "a note\n");
}

TEST(Progress, WritesLinesIntoALogAndOverItsLineOnATerminal)
{
  EXPECT_THAT(said(false, milliseconds(20)),
    MatchesRegex("(gnomon: rendering, 40 %, 0 s\n)+a note\n(gnomon: rendering, 40 %, 0 s\n)*"));
  EXPECT_THAT(said(true, milliseconds(20)),
    testing::AllOf(
      HasSubstr("gnomon: rendering, 40 %, 0 s\r\x1b[K"), HasSubstr("\r\x1b[Ka note\n")));
}

} // namespace
} // namespace gnomon::tool
