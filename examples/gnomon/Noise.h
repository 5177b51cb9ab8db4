#pragma once

#include <cmath>
#include <cstdint>

namespace gnomon::tool
{

/// Return a number in [0, 1) that depends only on three integers. It is the same on every machine,
/// unlike the standard library's distributions.
inline double hashed(int x, int y, std::uint32_t seed)
{
  std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x9e3779b1u +
    static_cast<std::uint32_t>(y) * 0x85ebca77u + seed * 0xc2b2ae3du;
  bits = (bits ^ (bits >> 16)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
  return (bits ^ bits >> 16) / 4294967296.0;
}

/// Return value noise in [0, 1): hashed numbers at integer coordinates, smooth in between.
inline double noise(double x, double y, std::uint32_t seed)
{
  const auto smooth = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const double u = smooth(x - column);
  const double v = smooth(y - row);
  const auto along = [&](int of)
  { return hashed(column, of, seed) * (1.0 - u) + hashed(column + 1, of, seed) * u; };
  return along(row) * (1.0 - v) + along(row + 1) * v;
}

/// A sequence of pseudorandom numbers, the same for the same seed.
class Random
{
public:
  explicit Random(std::uint32_t seed)
    : seed_(seed)
  {
  }

  /// Return the next number, in [low, high).
  double between(double low, double high)
  {
    return low + (high - low) * hashed(this->drawn_++, 0, this->seed_);
  }

private:
  std::uint32_t seed_;
  int drawn_ = 0;
};

} // namespace gnomon::tool
