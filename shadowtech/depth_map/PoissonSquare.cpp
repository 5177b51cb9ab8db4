#include "shadowtech/depth_map/PoissonSquare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace gnomon
{

//------------------------------------------------------------------------------
double wrappedDistance(const glm::dvec2& a, const glm::dvec2& b)
{
  const glm::dvec2 away = glm::abs(a - b);
  return glm::length(glm::min(away, 2.0 - away));
}

//------------------------------------------------------------------------------
double largestPoissonDistance(int points)
{
  return std::sqrt(2.0 / std::sqrt(3.0) * 4.0 / points);
}

//------------------------------------------------------------------------------
std::vector<glm::dvec2> poissonSquare(int points)
{
  // The standard's engines give the same numbers everywhere, its distributions do not.
  std::mt19937 random(1);
  const auto coordinate = [&random] { return random() / 2147483648.0 - 1.0; };
  constexpr int patience = 8000; // misses until the distance shrinks
  constexpr double shrinking = 0.98;
  double distance = largestPoissonDistance(points);
  std::vector<glm::dvec2> result;
  for (int misses = 0; result.size() < static_cast<std::size_t>(points);)
  {
    const double x = coordinate();
    const glm::dvec2 dart(x, coordinate());
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

} // namespace gnomon
