#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <random>

namespace gnomon::test
{

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline glm::dvec3 unitVector(Random& random)
{
  const double z = uniform(random, -1.0, 1.0);
  const double angle = uniform(random, 0.0, 6.283185307179586);
  const double radius = std::sqrt(1.0 - z * z);
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}

/// Return a point of the cube [-half, half]^3.
inline glm::dvec3 inCube(Random& random, double half = 1.0)
{
  const double x = uniform(random, -half, half);
  const double y = uniform(random, -half, half);
  return { x, y, uniform(random, -half, half) };
}

} // namespace gnomon::test
