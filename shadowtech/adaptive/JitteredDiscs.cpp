#include "shadowtech/adaptive/JitteredDiscs.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <cstddef>
#include <random>

namespace gnomon
{

//------------------------------------------------------------------------------
std::vector<glm::vec2> jitteredDiscs(int grid, int discs)
{
  // The standard's engines give the same numbers everywhere; its distributions do not.
  std::mt19937 random(1);
  const auto jittered = [&](int cell) { return (cell + random() / 4294967296.0) / grid; };
  std::vector<glm::vec2> points;
  points.reserve(static_cast<std::size_t>(discs) * static_cast<std::size_t>(grid * grid));
  for (int disc = 0; disc < discs; ++disc)
  {
    for (int row = grid - 1; row >= 0; --row)
    {
      for (int column = 0; column < grid; ++column)
      {
        const double angle = glm::two_pi<double>() * jittered(column);
        const double radius = std::sqrt(jittered(row));
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      }
    }
  }
  return points;
}

} // namespace gnomon
