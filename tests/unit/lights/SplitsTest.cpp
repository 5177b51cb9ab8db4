#include "lights/Splits.h"

#include "Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test
{
namespace
{

TEST(Splits, GrowFromTheNearestToTheFarthest)
{
  Random random(3);
  const auto unit = [&] { return uniform(random, 0.0, 1.0); };
  for (int i = 0; i < 1000; ++i)
  {
    const double n = i % 10 == 0 ? 0.0 : std::pow(10.0, 9.0 * unit() - 6.0);
    const double f = (n + 1e-3) * (1.0 + std::pow(10.0, 6.0 * unit() - 2.0));
    const double lambda = i % 3 == 0 ? 1.0 : unit();
    for (int count = 1; count <= mostSplits; ++count)
    {
      const auto splits = splitDistances({ n, f }, count, lambda);
      ASSERT_EQ(splits.size(), static_cast<std::size_t>(count) + 1);
      ASSERT_EQ(splits.front(), n);
      ASSERT_EQ(splits.back(), f);
      ASSERT_TRUE(
        std::adjacent_find(splits.begin(), splits.end(), std::greater_equal<>()) == splits.end());
    }
  }
}

TEST(Splits, AreTheSchemesOfThePaper)
{
  const auto uniform = splitDistances({ 1.0, 81.0 }, 4, 0.0);
  const auto logarithmic = splitDistances({ 1.0, 81.0 }, 4, 1.0);
  const auto practical = splitDistances({ 1.0, 81.0 }, 4, 0.25);
  for (std::size_t i = 0; i <= 4; ++i)
  {
    EXPECT_NEAR(uniform[i], 1.0 + 20.0 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(logarithmic[i], std::pow(3.0, static_cast<double>(i)), 1e-12);
    EXPECT_NEAR(practical[i], 0.25 * logarithmic[i] + 0.75 * uniform[i], 1e-12);
  }
}

TEST(Splits, StayFiniteWithoutAPositiveDistance)
{
  for (const DistanceInterval& interval :
    { DistanceInterval{ 0.0, 10.0 }, { -5.0, 10.0 }, { -5.0, -1.0 }, { 0.0, 0.0 }, { 2.0, 2.0 } })
  {
    for (const double lambda : { 0.0, 0.5, 1.0 })
    {
      const auto splits = splitDistances(interval, 8, lambda);
      EXPECT_TRUE(std::is_sorted(splits.begin(), splits.end()));
      EXPECT_EQ(splits.front(), interval.nearest);
      EXPECT_EQ(splits.back(), interval.farthest);
      for (const double distance : splits)
      {
        EXPECT_TRUE(std::isfinite(distance));
      }
    }
  }
}

} // namespace
} // namespace gnomon::test
