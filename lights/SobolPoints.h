#pragma once

#include "lights/SamplePixel.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Points of the unit cube: Sobol's sequence (1967; direction numbers of Joe and Kuo 2008),
/// scrambled by random triangular matrices (Matousek 1998). Pixels share one sequence and take
/// consecutive points along a Z curve whose parts are swapped at random (Ahmed and Wonka 2020).
/// Hence:
///
/// - Of 2^m points, a pixel has exactly one in each part of the unit square (the first two
///   coordinates) that is 2^-a wide and 2^(a-m) high.
/// - The points of 2 x 2, 4 x 4 and larger blocks of pixels are together as even as that many
///   points of one pixel. So errors of neighbours cancel: the noise is blue.
///
/// Scrambling and sequence are linear over bits, so a pixel's points are the first pixel's with
/// some bits flipped. If the number of points is no power of two, a pixel skips some points of its
/// part of the sequence, a different choice for each pixel.
class SobolPoints
{
public:
  SobolPoints(int count, std::uint32_t seed);

  SamplePixel pixel(std::uint32_t column, std::uint32_t row) const;

  /// Return point `i` of a pixel, as fractions of 2^32. For 2^m points, point i of all pixels lies
  /// in the same of 2^m equal parts of the square. So rays of neighbouring pixels that are traced
  /// together stay coherent.
  glm::uvec3 point(int i, const SamplePixel& pixel) const
  {
    return this->points_[static_cast<std::uint32_t>(i) ^ pixel.order] ^ pixel.bits;
  }

private:
  static constexpr int bitsOfWord = 32;
  /// The bits that each bit of a point's number flips in one of its coordinates.
  using Directions = std::array<std::uint32_t, bitsOfWord>;

  glm::uvec3 sobol(std::uint32_t number) const;
  std::uint32_t partOf(const glm::uvec3& point) const;

  std::array<Directions, 3> directions_;
  std::uint32_t orderSeed_;
  glm::uvec3 first_{ 0u }; ///< the sequence's first point
  int numberBits_ = 0;     ///< each pixel owns 2^numberBits_ numbers of the sequence, some unused
  bool hasParts_ = false;  ///< true if the number of points is a power of two
  ///@{
  /// The parts of the square that hold one point each: 2^columnBits_ columns, 2^rowBits_ rows.
  int columnBits_ = 0;
  int rowBits_ = 0;
  ///@}
  std::vector<glm::uvec3> points_; ///< of the first pixel, by part if hasParts_, else by number
};

} // namespace gnomon
