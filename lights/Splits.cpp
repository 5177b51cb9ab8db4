#include "lights/Splits.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

std::vector<double> splitDistances(const DistanceInterval& visible, int count, double lambda)
{
  const double n = visible.nearest;
  const double f = visible.farthest;
  const double logarithmicNear = n > 0.0 ? n : 1e-3 * f;
  std::vector<double> result{ n };
  for (int i = 1; i < count; ++i)
  {
    const double share = static_cast<double>(i) / count;
    const double uniform = n + (f - n) * share;
    // Logarithms need a positive distance.
    const double logarithmic =
      f > 0.0 ? logarithmicNear * std::pow(f / logarithmicNear, share) : uniform;
    result.push_back(std::clamp(lambda * logarithmic + (1.0 - lambda) * uniform, n, f));
  }
  result.push_back(f);
  return result;
}

} // namespace gnomon
