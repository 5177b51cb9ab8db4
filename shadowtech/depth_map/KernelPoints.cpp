#include "shadowtech/depth_map/KernelPoints.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace gnomon
{
namespace
{

/// Random numbers. The standard's engines give the same numbers everywhere, its distributions do
/// not.
class Random
{
public:
  /// Return a number in [0, 1).
  double share() { return this->engine_() / 4294967296.0; }
  /// Return a dart on the square [-1, 1]^2.
  glm::dvec2 dart()
  {
    const double x = 2.0 * this->share() - 1.0;
    return { x, 2.0 * this->share() - 1.0 };
  }

private:
  std::mt19937 engine_{ 1 };
};

/// Return points by dart throwing (Cook 1986).
std::array<glm::dvec2, poissonPoints> throwDarts()
{
  Random random;
  constexpr int patience = 1000; // misses until the disc is cleared
  std::array<glm::dvec2, poissonPoints> points{};
  auto end = points.begin();
  for (int misses = 0; end != points.end();)
  {
    const glm::dvec2 dart = random.dart();
    const bool free = glm::length(dart) <= 1.0 &&
      std::all_of(points.begin(), end,
        [&](const glm::dvec2& point) { return glm::distance(point, dart) >= poissonDistance; });
    if (free)
    {
      *end++ = dart;
    }
    else if (++misses > patience)
    {
      misses = 0;
      end = points.begin();
    }
  }
  return points;
}

} // namespace

const std::array<glm::dvec2, poissonPoints>& poissonDisc()
{
  static const std::array<glm::dvec2, poissonPoints> points = throwDarts();
  return points;
}

double wrappedDistance(const glm::dvec2& a, const glm::dvec2& b)
{
  const glm::dvec2 away = glm::abs(a - b);
  return glm::length(glm::min(away, 2.0 - away));
}

double largestPoissonDistance(int points)
{
  return std::sqrt(2.0 / std::sqrt(3.0) * 4.0 / points);
}

std::vector<glm::dvec2> poissonSquare(int points)
{
  Random random;
  constexpr int patience = 8000; // misses until the distance shrinks
  constexpr double shrinking = 0.98;
  double distance = largestPoissonDistance(points);
  std::vector<glm::dvec2> result;
  for (int misses = 0; result.size() < static_cast<std::size_t>(points);)
  {
    const glm::dvec2 dart = random.dart();
    const bool free = std::all_of(result.begin(), result.end(),
      [&](const glm::dvec2& point) { return wrappedDistance(point, dart) >= distance; });
    if (free)
    {
      result.push_back(dart);
    }
    else if (++misses > patience)
    {
      misses = 0;
      distance *= shrinking;
    }
  }
  return result;
}

std::vector<glm::vec2> jitteredDiscs(int grid, int discs)
{
  Random random;
  const auto jittered = [&](int cell) { return (cell + random.share()) / grid; };
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
