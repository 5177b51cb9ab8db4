#pragma once

#include <cstdint>

namespace gnomon::tool
{

/// A number in [0, 1) that depends on nothing but three integers: the same on every machine, which
/// the distributions of the standard library are not.
double hashed(int x, int y, std::uint32_t seed);

/// Value noise in [0, 1): hashed numbers at whole coordinates, smooth in between.
double noise(double x, double y, std::uint32_t seed);

/// A sequence of numbers that look random, the same for the same seed.
class Random
{
public:
  explicit Random(std::uint32_t seed)
    : seed_(seed)
  {
  }

  /// The next number in [low, high).
  double between(double low, double high);

private:
  std::uint32_t seed_;
  int drawn_ = 0;
};

} // namespace gnomon::tool
