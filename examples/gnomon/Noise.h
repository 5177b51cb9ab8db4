#pragma once

#include <cstdint>

namespace gnomon::tool
{

/// Return a number in [0, 1) that depends only on three integers. It is the same on every machine,
/// unlike the standard library's distributions.
double hashed(int x, int y, std::uint32_t seed);

/// Return value noise in [0, 1): hashed numbers at integer coordinates, smooth in between.
double noise(double x, double y, std::uint32_t seed);

/// A sequence of pseudorandom numbers, the same for the same seed.
class Random
{
public:
  explicit Random(std::uint32_t seed)
    : seed_(seed)
  {
  }

  /// Return the next number, in [low, high).
  double between(double low, double high);

private:
  std::uint32_t seed_;
  int drawn_ = 0;
};

} // namespace gnomon::tool
