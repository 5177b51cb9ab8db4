// Edges summed for all rays side by side, against one ray after another.

#include "RandomScenes.h"

#include "shadowtech/penumbra/EdgeSums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr float pixel = 1.0f / 64.0f;

/// On a grid, so products and sums are exact, and rays lie on edges and at their ends.
float onGrid(Random& random)
{
  return std::round(static_cast<float>(uniform(random, -1.0, 1.0)) / pixel) * pixel;
}

SeenEdge anyEdge(Random& random)
{
  SeenEdge edge{};
  edge.across = { onGrid(random), onGrid(random), onGrid(random) };
  edge.uncertain = random() % 2 ? 0.01f : -1.0f;
  edge.lower = onGrid(random);
  edge.upper = edge.lower + std::abs(onGrid(random));
  edge.uncertainLower = edge.lower - pixel;
  edge.uncertainUpper = edge.upper + pixel;
  edge.weight = static_cast<std::int32_t>(random() % 5) - 2;
  edge.weightBelow = static_cast<std::int32_t>(random() % 3) - 1;
  edge.below = onGrid(random);
  return edge;
}

/// A rotation that swaps and negates axes, so the turned values are not rounded.
glm::mat3 anyTurn(Random& random)
{
  const auto x = static_cast<glm::length_t>(random() % 3);
  const auto y = static_cast<glm::length_t>((x + 1 + random() % 2) % 3);
  glm::mat3 turn(0.0f);
  turn[0][x] = random() % 2 ? 1.0f : -1.0f;
  turn[1][y] = random() % 2 ? 1.0f : -1.0f;
  turn[2] = glm::cross(turn[0], turn[1]);
  return turn;
}

TEST(EdgeSums, areThoseOfOneRayAfterAnother)
{
  Random random(1);
  EdgeSums sums;
  // Pictures in which edges lower the total of the least count, and in which they raise it.
  int lowered = 0, raised = 0;
  for (const std::size_t count : { 1, 64, 7, 256, 16, 65, 23 }) // more and fewer than the last
  {
    for (int picture = 0; picture < 50; ++picture)
    {
      const glm::mat3 turn = anyTurn(random);
      std::vector<SeenEdge> edges(random() % 20);
      std::generate(edges.begin(), edges.end(), [&] { return anyEdge(random); });
      std::array<std::vector<float>, 3> axes;
      std::vector<std::uint32_t> uncertain{ 12345u }, raysOfCertain;
      std::vector<std::int32_t> certain;
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const glm::vec3 ray(onGrid(random), onGrid(random), 1.0f);
        const float length = std::ldexp(1.0f, static_cast<int>(random() % 5) - 2);
        const glm::vec3 direction = glm::transpose(turn) * (length * ray);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          axes[axis].push_back(direction[static_cast<glm::length_t>(axis)]);
        }
        std::int32_t sum = 0;
        bool unclear = false;
        for (const SeenEdge& edge : edges)
        {
          const float side = glm::dot(edge.across, ray), y = ray.y;
          sum += side > 0.0f && y >= edge.lower && y < edge.upper ? edge.weight : 0;
          sum += y < edge.below ? edge.weightBelow : 0;
          unclear = unclear ||
            (std::abs(side) <= edge.uncertain && y >= edge.uncertainLower &&
              y <= edge.uncertainUpper);
        }
        if (unclear)
        {
          uncertain.push_back(i);
          continue;
        }
        certain.push_back(sum);
        raysOfCertain.push_back(i);
      }
      sums.setRays(turn, { axes[0].data(), axes[1].data(), axes[2].data() }, count);
      sums.add(edges);
      std::vector<std::uint32_t> found{ 12345u };
      sums.appendUncertain(found);
      EXPECT_EQ(found, uncertain);
      const EdgeSums::Fewest fewest = sums.fewest();
      if (certain.empty())
      {
        EXPECT_EQ(fewest.count, 0u);
        continue;
      }
      const auto least = std::min_element(certain.begin(), certain.end());
      EXPECT_EQ(fewest.count, std::count(certain.begin(), certain.end(), *least));
      EXPECT_EQ(fewest.first, raysOfCertain[static_cast<std::size_t>(least - certain.begin())]);
      lowered += *least < 0 ? 1 : 0;
      raised += *least > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lowered, 50);
  EXPECT_GT(raised, 20);
}

} // namespace
} // namespace gnomon::test
