#include "lights/SobolPoints.h"

#include <cstddef>

namespace gnomon
{
namespace
{

/// Hash a word ("lowbias32", Wellons 2018).
std::uint32_t hashOf(std::uint32_t x)
{
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Return a direction number of the first dimension, which reverses a number's bits behind the
/// binary point.
constexpr std::uint32_t direction(std::size_t bit)
{
  return 0x80000000u >> bit;
}

/// Multiply a direction number by the seed's triangular matrix: a bit stays, and flips random bits
/// behind it.
std::uint32_t scrambled(std::uint32_t from, std::uint32_t seed)
{
  std::uint32_t to = 0;
  for (std::size_t bit = 0; from != 0; ++bit, from <<= 1)
  {
    if ((from & 0x80000000u) != 0)
    {
      const std::uint32_t first = direction(bit);
      to ^= first | (hashOf(seed + static_cast<std::uint32_t>(bit)) & (first - 1u));
    }
  }
  return to;
}

/// Return the low 16 bits of a word with a zero between any two.
std::uint32_t spread(std::uint32_t x)
{
  x &= 0x0000ffffu;
  x = (x | (x << 8)) & 0x00ff00ffu;
  x = (x | (x << 4)) & 0x0f0f0f0fu;
  x = (x | (x << 2)) & 0x33333333u;
  return (x | (x << 1)) & 0x55555555u;
}

/// Return a number on a Z curve whose parts, of any size, are swapped at random. A hash of the bits
/// before a bit flips it.
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
std::uint32_t
shuffled(std::uint32_t number, std::uint32_t seed)
{
  std::uint32_t flipped = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit)
  {
    const std::uint32_t before = number >> bit >> 1;
    flipped ^= (hashOf(hashOf(before + seed) + bit) & 1u) << bit;
  }
  return number ^ flipped;
}

} // namespace

SobolPoints::SobolPoints(int count, std::uint32_t seed)
  : orderSeed_(hashOf(seed + 4u))
{
  // The second dimension's polynomial is x + 1, the third's x^2 + x + 1 with initial numbers 1 and
  // 3.
  Directions& first = this->directions_[0];
  Directions& second = this->directions_[1];
  Directions& third = this->directions_[2];
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    first[i] = direction(i);
    second[i] = i == 0 ? direction(0) : second[i - 1] ^ (second[i - 1] >> 1);
    third[i] = i == 0 ? direction(0)
      : i == 1        ? 3u << 30
                      : third[i - 1] ^ third[i - 2] ^ (third[i - 2] >> 2);
  }
  for (std::size_t axis = 0; axis < this->directions_.size(); ++axis)
  {
    const std::uint32_t seedOfAxis = hashOf(seed + 1u + static_cast<std::uint32_t>(axis));
    for (std::uint32_t& number : this->directions_[axis])
    {
      number = scrambled(number, seedOfAxis);
    }
    this->first_[static_cast<glm::length_t>(axis)] = hashOf(seedOfAxis + 32u);
  }

  const auto most = static_cast<std::uint32_t>(count);
  while (1u << this->numberBits_ < most)
  {
    ++this->numberBits_;
  }
  const std::uint32_t numbers = 1u << this->numberBits_;
  this->hasParts_ = numbers == most;
  this->columnBits_ = (this->numberBits_ + 1) / 2;
  this->rowBits_ = this->numberBits_ / 2;
  this->points_.resize(numbers);
  for (std::uint32_t i = 0; i < numbers; ++i)
  {
    const glm::uvec3 point = this->sobol(i);
    this->points_[this->hasParts_ ? this->partOf(point) : i] = point;
  }
}

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
glm::uvec3
SobolPoints::sobol(std::uint32_t number) const
{
  std::uint32_t x = this->first_.x, y = this->first_.y, z = this->first_.z;
  for (std::uint32_t bit = 0; bit < bitsOfWord; ++bit)
  {
    const std::uint32_t all = 0u - (number >> bit & 1u); // all of a word's bits, or none
    x ^= this->directions_[0][bit] & all;
    y ^= this->directions_[1][bit] & all;
    z ^= this->directions_[2][bit] & all;
  }
  return { x, y, z };
}

std::uint32_t SobolPoints::partOf(const glm::uvec3& point) const
{
  const auto leading = [](std::uint32_t word, int bits)
  { return bits == 0 ? 0u : word >> (bitsOfWord - bits); }; // a shift by all bits is undefined
  return (leading(point.y, this->rowBits_) << this->columnBits_) |
    leading(point.x, this->columnBits_);
}

SamplePixel SobolPoints::pixel(std::uint32_t column, std::uint32_t row) const
{
  const std::uint32_t place = shuffled(spread(column) | (spread(row) << 1), this->orderSeed_);
  SamplePixel pixel;
  pixel.bits = this->sobol(place << this->numberBits_) ^ this->first_;
  // Flipping bits permutes the parts of the square: the point in part i comes from part i ^ order.
  // Without parts, any order that permutes the numbers will do.
  const std::uint32_t numbers = static_cast<std::uint32_t>(this->points_.size());
  pixel.order =
    this->hasParts_ ? this->partOf(pixel.bits) : hashOf(place + this->orderSeed_) & (numbers - 1u);
  return pixel;
}

} // namespace gnomon
