// The judge of the hard cases finds planted errors, and no others.

#include "Judge.h"
#include "Matrix.h"

#include "Errors.h"
#include "TestFiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon::hard
{
namespace
{

const Row& rowOf(const std::string& name)
{
  return *std::find_if(
    rows().begin(), rows().end(), [&](const Row& row) { return row.name == name; });
}

const Column& columnOf(const std::string& name)
{
  return *std::find_if(
    columns().begin(), columns().end(), [&](const Column& column) { return column.name == name; });
}

Outcome outcomeOf(const std::string& row, const Column& column)
{
  return drawRow(rowOf(row), { &column }).front().outcome;
}

/// A receiver on the floor of a scene whose box hides the sun from z = -1 to 1.
Receiver onFloor(double z)
{
  return { { -1.0, 0.0, z }, { 0.0, 1.0, 0.0 } };
}

} // namespace

TEST(Judge, findsEdgesWithinADistanceAndNoOthers)
{
  const Judge judge(tool::loadScene("hard-sun-straight-down"));
  for (const double z : { 1.1, 0.9 })
  {
    EXPECT_EQ(judge.isLit(onFloor(z), 0, judge.storedOffset()), z > 1.0);
    EXPECT_TRUE(judge.isNearEdge(onFloor(z), 0, 0.11)) << z;
    EXPECT_FALSE(judge.isNearEdge(onFloor(z), 0, 0.09)) << z;
  }
  EXPECT_TRUE(judge.isOnFloor(onFloor(0.0)));
  EXPECT_FALSE(judge.isOnFloor({ { -1.0, 2.0, 0.0 }, { 0.0, 1.0, 0.0 } }));
}

TEST(Judge, findsWhatIsThinOrSmallForTheDistance)
{
  const Judge posts(tool::loadScene("hard-thin-posts"));
  // Seen from the sun, a post as thin as a fiftieth of the distance ends 0.4 from here.
  const Receiver beside{ { 2.1, 0.0, -0.05 }, { 0.0, 1.0, 0.0 } };
  EXPECT_TRUE(posts.isNearEdge(beside, 0, 1.0));
  const Judge small(tool::loadScene("hard-small-on-large"));
  EXPECT_TRUE(small.isNearEdge({ { 1.0, 0.0, 0.3 }, { 0.0, 1.0, 0.0 } }, 0, 300.0));
}

TEST(Matrix, areBrokenByWhatIsWrong)
{
  const std::string row = "hard-stacked-plates";
  EXPECT_EQ(outcomeOf(row, { "leaks", "nsm:bias_constant=0.3", Kind::Map }), Outcome::Broken);
  EXPECT_EQ(outcomeOf(row, { "errs", "nsm", Kind::Exact }), Outcome::Broken);
  EXPECT_EQ(outcomeOf("hard-soft-long-box", { "sampled", "sampled:light_samples=1", Kind::Soft }),
    Outcome::Broken);
  EXPECT_EQ(outcomeOf(row, columnOf("nsm")), Outcome::Kept);
  EXPECT_EQ(outcomeOf(row, columnOf("silhouette")), Outcome::Kept);
  EXPECT_EQ(outcomeOf("hard-wide-cone", columnOf("lispsm")), Outcome::Refused);
}

TEST(Matrix, surpriseWhereTheyAreNotAsTheTableSays)
{
  const tool::TestFolder folder;
  const std::string path = folder / "cells.tsv";
  const auto known = [&](const std::string& text)
  {
    tool::writeBytes(path, text);
    return readKnownCells(path);
  };
  Cell cell{ &rowOf("hard-far-away"), &columnOf("esm") };
  const std::string line = "hard-far-away\tesm\tleaks\n";
  for (const Outcome outcome : { Outcome::Kept, Outcome::Broken })
  {
    cell.outcome = outcome;
    const bool isBroken = outcome == Outcome::Broken;
    EXPECT_EQ(surprisesIn({ cell }, known("# none\n")).size(), isBroken ? 1u : 0u);
    EXPECT_EQ(surprisesIn({ cell }, known(line)).size(), isBroken ? 0u : 1u);
  }
  for (const char* text :
    { "hard-far-away\tesm\n", "nowhere\tesm\tleaks\n", "hard-far-away\tx\ty" })
  {
    EXPECT_THROW(known(text), tool::BadInput) << text;
  }
}

} // namespace gnomon::hard
