#include "shadowtech/depth_map/PoissonDisc.h"

#include <algorithm>
#include <random>

namespace gnomon
{
namespace
{

/// Return points by dart throwing (Cook 1986). The standard's engines give the same numbers
/// everywhere, its distributions do not.
std::array<glm::dvec2, poissonPoints> throwDarts()
{
  std::mt19937 random(1);
  const auto coordinate = [&random] { return random() / 2147483648.0 - 1.0; };
  constexpr int patience = 1000; // misses until the disc is cleared
  std::array<glm::dvec2, poissonPoints> points{};
  auto end = points.begin();
  for (int misses = 0; end != points.end();)
  {
    const double x = coordinate();
    const glm::dvec2 dart(x, coordinate());
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

//------------------------------------------------------------------------------
const std::array<glm::dvec2, poissonPoints>& poissonDisc()
{
  static const std::array<glm::dvec2, poissonPoints> points = throwDarts();
  return points;
}

} // namespace gnomon
