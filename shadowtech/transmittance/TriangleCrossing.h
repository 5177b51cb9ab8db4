#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace gnomon
{

/// A sum of doubles without rounding: parts that do not overlap, in rising magnitude.
class ExactSum
{
public:
  /// Add a number (Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic, Grow-Expansion).
  void add(double number)
  {
    for (std::size_t i = 0; i < this->count_; ++i)
    {
      const double sum = number + this->parts_[i];
      const double shared = sum - number;
      this->parts_[i] = (number - (sum - shared)) + (this->parts_[i] - shared);
      number = sum;
    }
    this->parts_[this->count_++] = number;
  }
  void addProduct(double a, double b)
  {
    const double product = a * b;
    this->add(std::fma(a, b, -product));
    this->add(product);
  }
  void addProduct(double a, double b, double c)
  {
    const double product = a * b;
    this->addProduct(std::fma(a, b, -product), c);
    this->addProduct(product, c);
  }
  int sign() const
  {
    for (std::size_t i = this->count_; i-- > 0;)
    {
      if (this->parts_[i] != 0.0)
      {
        return this->parts_[i] > 0.0 ? 1 : -1;
      }
    }
    return 0;
  }

private:
  std::array<double, 24> parts_{}; // as many as six products of three numbers have
  std::size_t count_ = 0;
};

/// Return the sign of a x b along one axis, without rounding.
inline int signOfCross(const glm::dvec3& a, const glm::dvec3& minusA, const glm::dvec3& b, int axis)
{
  const int y = (axis + 1) % 3;
  const int z = (axis + 2) % 3;
  ExactSum sum;
  sum.addProduct(a[y], b[z]);
  sum.addProduct(-minusA[y], b[z]);
  sum.addProduct(-a[z], b[y]);
  sum.addProduct(minusA[z], b[y]);
  return sum.sign();
}

/// A line's side of an edge.
struct EdgeSide
{
  double volume; ///< direction . (a x b), rounded
  int sign;      ///< of the exact volume of the moved line; 0 only for an edge along the line
};

inline EdgeSide sideOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& direction)
{
  const glm::dvec3 one(a.y * b.z, a.z * b.x, a.x * b.y);
  const glm::dvec3 other(a.z * b.y, a.x * b.z, a.y * b.x);
  const double volume = glm::dot(direction, one - other);
  // Each of the six products is rounded at most five times.
  const double error = 4.0 * std::numeric_limits<double>::epsilon() *
    glm::dot(glm::abs(direction), glm::abs(one) + glm::abs(other));
  if (std::abs(volume) > error)
  {
    return { volume, volume > 0.0 ? 1 : -1 };
  }
  ExactSum sum;
  for (int x = 0; x < 3; ++x)
  {
    const int y = (x + 1) % 3;
    const int z = (x + 2) % 3;
    sum.addProduct(a[y], b[z], direction[x]);
    sum.addProduct(-a[z], b[y], direction[x]);
  }
  int sign = sum.sign();
  // A line moved by m has the volume direction . (a x b) + m . ((a - b) x direction).
  for (int axis = 0; sign == 0 && axis < 3; ++axis)
  {
    sign = signOfCross(a, b, direction, axis);
  }
  return { volume, sign };
}

/// Where a line crosses a triangle.
struct TriangleCrossing
{
  double at;          ///< in lengths of the direction
  glm::dvec3 weights; ///< barycentric, by corner
  bool leavesFront;   ///< the line leaves on the side that shows the corners counter-clockwise
};

/// Return where a line crosses a triangle; none if it misses it or lies in its plane.
///
/// Triangles that share an edge or a corner partition the line's hits: of those around it, a line
/// through it crosses exactly as many as a line next to it. The signs of the three edge functions
/// are exact. Where one is 0, the line counts as moved by (e, e^2, e^3) for an infinitely small e
/// (Edelsbrunner and Muecke 1990, Simulation of Simplicity), by which no edge function is 0 unless
/// the line is parallel to the edge.
///
/// @param corners less the line's origin. Equal corners must be equal bit for bit
/// @param direction of any length but 0
inline std::optional<TriangleCrossing> crossingOf(
  const std::array<glm::dvec3, 3>& corners, const glm::dvec3& direction)
{
  const EdgeSide ofSecond = sideOf(corners[2], corners[0], direction);
  const EdgeSide ofThird = sideOf(corners[0], corners[1], direction);
  if (ofSecond.sign == 0 || ofThird.sign != ofSecond.sign)
  {
    return std::nullopt;
  }
  const EdgeSide ofFirst = sideOf(corners[1], corners[2], direction);
  if (ofFirst.sign != ofSecond.sign)
  {
    return std::nullopt;
  }
  // Rounding may leave a weight of the wrong sign, but the crossing lies within the triangle.
  glm::dvec3 weights = glm::abs(glm::dvec3(ofFirst.volume, ofSecond.volume, ofThird.volume));
  const double sum = weights.x + weights.y + weights.z;
  weights = sum > 0.0 ? weights / sum : glm::dvec3(1.0 / 3.0); // 0: seen along its plane
  const glm::dvec3 place = weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
  return TriangleCrossing{ glm::dot(place, direction) / glm::dot(direction, direction), weights,
    ofFirst.sign > 0 };
}

} // namespace gnomon
