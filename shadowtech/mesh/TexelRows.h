#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{

/// @file
/// Finds which texels of a row lie inside straight sides.

/// Columns or rows from first to last, both included; empty if first > last.
struct Span
{
  int first, last;
};

/// Return the rows or columns in [0, limit) that a range of texel coordinates meets; none if first
/// > last.
inline Span spanOf(double low, double high, int limit)
{
  return { static_cast<int>(std::floor(std::clamp(low, 0.0, static_cast<double>(limit)))),
    static_cast<int>(std::floor(std::clamp(high, -1.0, limit - 1.0))) };
}

/// Return the factor that turns `rest` into the x where nx x + rest = 0; 0 if a side runs along the
/// row.
inline double boundPerRest(double nx)
{
  return std::abs(nx) > 1e-12 ? -1.0 / nx : 0.0;
}

/// The range of a row inside a polygon's sides.
struct RowRange
{
  double low, high; ///< x of texels' centres

  /// Clip to nx x + rest >= 0.
  /// @param perRest boundPerRest(nx)
  void cut(double perRest, double rest)
  {
    if (perRest < 0.0)
    {
      this->low = std::max(this->low, rest * perRest);
    }
    else if (perRest > 0.0)
    {
      this->high = std::min(this->high, rest * perRest);
    }
    else if (rest < 0.0)
    {
      this->high = -std::numeric_limits<double>::infinity();
    }
  }
  /// Return the texels whose point at offset `at`, in [0, 1), lies in the range.
  Span texels(double at, int width) const
  {
    return { static_cast<int>(
               std::ceil(std::clamp(this->low - at, 0.0, static_cast<double>(width)))),
      static_cast<int>(std::floor(std::clamp(this->high - at, -1.0, width - 1.0))) };
  }
};

} // namespace gnomon
