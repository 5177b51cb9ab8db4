#ifndef gnomon_shadowtech_conservative_TexelRows_h
#define gnomon_shadowtech_conservative_TexelRows_h

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{

/// @file
/// Which texels of a map's rows lie inside straight sides.

/// Columns or rows, from the first to the last.
struct Span
{
  int first, last;
};

/// The rows or columns below `limit` that a range of texel coordinates meets; none if first > last.
inline Span spanOf(double low, double high, int limit)
{
  return { static_cast<int>(std::floor(std::clamp(low, 0.0, static_cast<double>(limit)))),
    static_cast<int>(std::floor(std::clamp(high, -1.0, limit - 1.0))) };
}

/// Texels of a row, those that a polygon's sides leave.
struct RowRange
{
  double low, high; ///< of texels' centres

  void cut(double nx, double rest) // nx x + rest >= 0
  {
    if (nx > 1e-12)
    {
      this->low = std::max(this->low, -rest / nx);
    }
    else if (nx < -1e-12)
    {
      this->high = std::min(this->high, -rest / nx);
    }
    else if (rest < 0.0)
    {
      this->high = -std::numeric_limits<double>::infinity();
    }
  }
  /// The texels whose point at `at` in [0, 1) lies in the range.
  Span texels(double at, int width) const
  {
    return { static_cast<int>(
               std::ceil(std::clamp(this->low - at, 0.0, static_cast<double>(width)))),
      static_cast<int>(std::floor(std::clamp(this->high - at, -1.0, width - 1.0))) };
  }
};

} // namespace gnomon

#endif
