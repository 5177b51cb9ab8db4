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

/// A vector of length 1; the vector itself where it has no length.
inline Vec3 normalized(const Vec3& a)
{
  const double size = length(a);
  return size > 0.0 ? (1.0 / size) * a : a;
}

} // namespace gnomon::tool
