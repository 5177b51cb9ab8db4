#include "Progress.h"

#include <gmock/gmock.h>

#include <sstream>

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
  std::ostringstream stream;
  {
    Progress progress("reading", stream, isTerminal, silence);
    progress.begin("rendering", 0.4);
    std::this_thread::sleep_for(milliseconds(200));
    progress.print("a note", stream);
  }
  return stream.str();
}

TEST(Progress, IsSilentAboutShortWork)
{
  EXPECT_EQ(said(false, milliseconds(10000)), "a note\n");
  EXPECT_EQ(said(true, milliseconds(10000)), "a note\n");
}

TEST(Progress, WritesLinesIntoALog)
{
  EXPECT_THAT(said(false, milliseconds(20)),
    MatchesRegex("(gnomon: rendering, 40 %, 0 s\n)+a note\n(gnomon: rendering, 40 %, 0 s\n)*"));
}

TEST(Progress, WritesOverItsLineOnATerminal)
{
  const std::string text = said(true, milliseconds(20));
  EXPECT_THAT(text, HasSubstr("gnomon: rendering, 40 %, 0 s\r\x1b[K"));
  EXPECT_THAT(text, HasSubstr("\r\x1b[Ka note\n"));
}

} // namespace
} // namespace gnomon::tool
