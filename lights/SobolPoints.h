#pragma once

#include "lights/SamplePixel.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Points of the unit cube: Sobol's sequence (1967; direction numbers of Joe and Kuo 2008),
/// scrambled by random triangular matrices (Matousek 1998). Each pixel gets the next points of the
/// one sequence, in an order in which neighbours follow each other: along a Z curve whose parts are
/// swapped at random (Ahmed and Wonka 2020). So
///
/// - of 2^m points a pixel has exactly one in each part of the unit square (the first two
///   coordinates) that is 2^-a wide and 2^(a-m) high;
/// - those of 2 x 2 pixels, 4 x 4 and so on are together as even as so many points of one pixel, so
///   that errors of neighbours cancel each other: their noise is blue.
///
/// Scrambling and sequence are linear over bits, so that a pixel's points are the first pixel's
/// with some bits flipped. Of other numbers of points a pixel leaves out some of its own of the
/// sequence, another choice for each.
class SobolPoints
{
public:
  SobolPoints(int count, std::uint32_t seed);

  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const;

  /// Point `i` of a pixel: fractions of 2^32. Of a power of two of points, point i of any pixel
  /// lies in the same one of as many equal parts of the square: what pixels side by side trace
  /// together stays together.
  glm::uvec3 point(int i, const SamplePixel& pixel) const
  {
    return this->points_[static_cast<std::uint32_t>(i) ^ pixel.order] ^ pixel.bits;
  }

private:
  static constexpr int bitsOfWord = 32;
  /// What each bit of a point's number flips in one of its coordinates.
  using Directions = std::array<std::uint32_t, bitsOfWord>;

  glm::uvec3 sobol(std::uint32_t number) const;
  std::uint32_t partOf(const glm::uvec3& point) const;

  std::array<Directions, 3> directions_;
  std::uint32_t orderSeed_;
  glm::uvec3 first_{ 0u }; ///< the sequence's first point
  int numberBits_ =
    0; ///< each pixel has 2^numberBits_ numbers of the sequence, which it may not use up
  bool hasParts_ = false; ///< it has: a power of two of points
  ///@{
  /// The parts of the square that hold a point each: 2^columnBits_ across.
  int columnBits_ = 0;
  int rowBits_ = 0;
  ///@}
  std::vector<glm::uvec3> points_; ///< of the first pixel's numbers; where there are parts, by part
};

} // namespace gnomon
