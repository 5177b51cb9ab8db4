#include "plugin/ranks/ManyRanks.h"

#include "SplitScene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

struct RanksTest : testing::Test
{
  ManyRanks ranks_{ controller() };
};

} // namespace

TEST_F(RanksTest, ReduceAndGather)
{
  const int own = this->ranks_.own();
  const int count = this->ranks_.count();
  ASSERT_EQ(this->ranks_.beginFrame(""), "");
  EXPECT_TRUE(this->ranks_.isAny(own == count - 1));
  EXPECT_FALSE(this->ranks_.isAny(false));

  Bounds bounds;
  EXPECT_TRUE(this->ranks_.united(bounds).empty());
  if (own > 0)
  {
    bounds.add(glm::dvec3(own, 0.0, -own));
  }
  const Bounds united = this->ranks_.united(bounds);
  EXPECT_EQ(united.lower, glm::dvec3(1.0, 0.0, 1 - count));
  EXPECT_EQ(united.upper, glm::dvec3(count - 1, 0.0, -1.0));

  std::vector<float> numbers{ static_cast<float>(own), static_cast<float>(-own), 0.5f };
  this->ranks_.reduceToLeast(numbers);
  EXPECT_EQ(numbers, (std::vector<float>{ 0.0f, static_cast<float>(1 - count), 0.5f }));

  std::vector<std::uint64_t> bits{ std::uint64_t(1) << own, std::uint64_t(1) << 63 };
  this->ranks_.uniteBits(bits);
  EXPECT_EQ(bits[0], (std::uint64_t(1) << count) - 1);
  EXPECT_EQ(bits[1], std::uint64_t(1) << 63);

  const std::vector<glm::dvec2> mine(static_cast<std::size_t>(own), glm::dvec2(own, -own));
  Ranks::Gathered<glm::dvec2> all;
  this->ranks_.gather(mine, all);
  ASSERT_EQ(all.firsts.size(), static_cast<std::size_t>(count) + 1);
  EXPECT_EQ(all.elements.size(), static_cast<std::size_t>(count * (count - 1) / 2));
  for (int rank = 0; rank < count; ++rank)
  {
    const auto number = static_cast<std::size_t>(rank);
    EXPECT_EQ(all.firsts[number + 1] - all.firsts[number], number);
    for (std::size_t i = all.firsts[number]; i < all.firsts[number + 1]; ++i)
    {
      EXPECT_EQ(all.elements[i], glm::dvec2(rank, -rank));
    }
  }
  this->ranks_.requireSame([] { return 42; }, "answers");
  this->ranks_.endFrame();
}

TEST_F(RanksTest, TellsAllOfAFailure)
{
  ASSERT_EQ(this->ranks_.beginFrame(""), "");
  const int last = this->ranks_.count() - 1;
  if (this->ranks_.own() == last)
  {
    this->ranks_.fail("no memory");
    this->ranks_.fail("not told: the frame is over");
  }
  else
  {
    try
    {
      this->ranks_.isAny(true);
      FAIL() << "another process failed";
    }
    catch (const RankFailure& failure)
    {
      EXPECT_EQ(failure.what(),
        "process " + std::to_string(last) + " of " + std::to_string(last + 1) +
          " failed: no memory");
    }
    this->ranks_.fail("not told: the frame is over");
  }

  const std::string error = this->ranks_.beginFrame(this->ranks_.own() == 0 ? "no OpenGL" : "");
  EXPECT_EQ(error, "process 0 of " + std::to_string(last + 1) + " failed: no OpenGL");

  ASSERT_EQ(this->ranks_.beginFrame(""), "");
  const auto own = [this] { return static_cast<std::uint64_t>(this->ranks_.own()); };
  EXPECT_THROW(this->ranks_.requireSame(own, "numbers"), RankFailure);
  ASSERT_EQ(this->ranks_.beginFrame(""), "");
  this->ranks_.endFrame();
}

TEST(RankAlone, EchoesItsInput)
{
  EXPECT_EQ(alone().count(), 1);
  EXPECT_EQ(alone().beginFrame(""), "");
  EXPECT_EQ(alone().beginFrame("no OpenGL"), "no OpenGL");
  EXPECT_TRUE(alone().isAny(true));
  EXPECT_FALSE(alone().isAny(false));
  EXPECT_EQ(alone().sum(-7), -7);
  std::vector<float> numbers{ 3.0f, 1.0f };
  alone().reduceToLeast(numbers);
  EXPECT_EQ(numbers, (std::vector<float>{ 3.0f, 1.0f }));
  Ranks::Gathered<float> all;
  alone().gather(numbers, all);
  EXPECT_EQ(all.elements, numbers);
  EXPECT_EQ(all.firsts, (std::vector<std::size_t>{ 0, 2 }));
}

} // namespace gnomon::test
