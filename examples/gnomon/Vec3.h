#pragma once

#include "Scene.h"

#include <cmath>

namespace gnomon::tool
{

inline Vec3 operator-(const Vec3& a)
{
  return { { -a[0], -a[1], -a[2] } };
}

inline Vec3 operator+(const Vec3& a, const Vec3& b)
{
  return { { a[0] + b[0], a[1] + b[1], a[2] + b[2] } };
}

inline Vec3 operator-(const Vec3& a, const Vec3& b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

inline Vec3 operator*(double scale, const Vec3& a)
{
  return { { scale * a[0], scale * a[1], scale * a[2] } };
}

inline Vec3 cross(const Vec3& a, const Vec3& b)
{
  return { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] } };
}

inline double dot(const Vec3& a, const Vec3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double length(const Vec3& a)
{
  return std::hypot(a[0], a[1], a[2]);
}

/// Return the vector scaled to length 1; a vector without length stays unchanged.
inline Vec3 normalized(const Vec3& a)
{
  const double size = length(a);
  return size > 0.0 ? (1.0 / size) * a : a;
}

/// Transform a point (w = 1) or a direction (w = 0) by a row-major matrix.
inline Vec3 transformed(const std::array<double, 16>& matrix, const Vec3& v, double w)
{
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double* row = matrix.data() + 4 * i;
    result[i] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * w;
  }
  return result;
}

} // namespace gnomon::tool
