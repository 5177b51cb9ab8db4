#include "Noise.h"

#include <cmath>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
double hashed(int x, int y, std::uint32_t seed)
{
  std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x9e3779b1u +
    static_cast<std::uint32_t>(y) * 0x85ebca77u + seed * 0xc2b2ae3du;
  bits = (bits ^ (bits >> 16)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
  bits ^= bits >> 16;
  return bits / 4294967296.0;
}

//------------------------------------------------------------------------------
double noise(double x, double y, std::uint32_t seed)
{
  const auto smooth = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const double u = smooth(x - column);
  const double v = smooth(y - row);
  const double low = hashed(column, row, seed) * (1.0 - u) + hashed(column + 1, row, seed) * u;
  const double high =
    hashed(column, row + 1, seed) * (1.0 - u) + hashed(column + 1, row + 1, seed) * u;
  return low * (1.0 - v) + high * v;
}

//------------------------------------------------------------------------------
double Random::between(double low, double high)
{
  return low + (high - low) * hashed(this->drawn_++, 0, this->seed_);
}

} // namespace gnomon::tool
