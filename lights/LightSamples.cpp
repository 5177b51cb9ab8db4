#include "lights/LightSamples.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon
{
namespace
{

constexpr int bitsOfWord = 32;

std::uint32_t reversed(std::uint32_t x)
{
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// A well mixed number of one ("lowbias32" of Wellons 2018).
std::uint32_t hashOf(std::uint32_t x)
{
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Flips each bit by a hash of the bits above it (Laine and Karras 2011, with Burley's constants): Owen's
/// scrambling.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed)
{
  x = reversed(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reversed(x);
}

/// Direction numbers of a dimension of Sobol's sequence.
using Directions = std::array<std::uint32_t, bitsOfWord>;

/// Of the second dimension: the polynomial x + 1.
Directions directionsOfSecond()
{
  Directions directions;
  directions[0] = 1u << 31;
  for (std::size_t i = 1; i < directions.size(); ++i)
  {
    directions[i] = directions[i - 1] ^ (directions[i - 1] >> 1);
  }
  return directions;
}

/// Of the third: x^2 + x + 1, begun by 1 and 3.
Directions directionsOfThird()
{
  Directions directions;
  directions[0] = 1u << 31;
  directions[1] = 3u << 30;
  for (std::size_t i = 2; i < directions.size(); ++i)
  {
    directions[i] = directions[i - 1] ^ directions[i - 2] ^ (directions[i - 2] >> 2);
  }
  return directions;
}

std::uint32_t sobol(std::uint32_t i, const Directions& directions)
{
  std::uint32_t point = 0;
  for (std::size_t bit = 0; i != 0; ++bit, i >>= 1)
  {
    point ^= (i & 1u) != 0 ? directions[bit] : 0u;
  }
  return point;
}

/// The leading bits of a word.
std::uint32_t leading(std::uint32_t word, int bits)
{
  return bits == 0 ? 0u : word >> (bitsOfWord - bits); // a shift by all bits is undefined
}

/// A word's fraction of 2^32 in [0, 1): as many bits as a float holds.
float fractionOf(std::uint32_t word)
{
  return static_cast<float>(word >> 8) * 5.9604645e-8f; // 2^-24
}

/// Sines and cosines for |angle| <= pi / 2, to 1e-7: polynomials, which are the same on all machines.
float sineOf(float angle)
{
  const float square = angle * angle;
  return angle *
    (1.0f -
      square / 6.0f *
        (1.0f -
          square / 20.0f *
            (1.0f - square / 42.0f * (1.0f - square / 72.0f * (1.0f - square / 110.0f)))));
}
float cosineOf(float angle)
{
  const float square = angle * angle;
  return 1.0f -
    square / 2.0f *
    (1.0f -
      square / 12.0f * (1.0f - square / 30.0f * (1.0f - square / 56.0f * (1.0f - square / 90.0f))));
}

/// The concentric map from the square of half side 1 to the unit disk.
glm::vec2 diskPoint(const glm::vec2& square)
{
  const bool wide = std::abs(square.x) > std::abs(square.y);
  const float radius = wide ? square.x : square.y;
  const float other = wide ? square.y : square.x;
  // The middle of the square is that of the disk.
  const float angle = radius == 0.0f ? 0.0f : glm::quarter_pi<float>() * (other / radius);
  const float along = radius * cosineOf(angle);
  const float across = radius * sineOf(angle);
  return wide ? glm::vec2(along, across) : glm::vec2(across, along);
}

} // namespace

//------------------------------------------------------------------------------
LightSamples::LightSamples(const ShadowLight& light)
  : points_(static_cast<std::size_t>(light.lightSamples))
  , seed_(hashOf(static_cast<std::uint32_t>(light.lightSeed)))
  , shape_(light.area->shape)
  , worldFromUnit_(light.area->worldFromUnit)
{
  const Directions second = directionsOfSecond();
  const Directions third = directionsOfThird();
  for (std::size_t i = 0; i < this->points_.size(); ++i)
  {
    const auto number = static_cast<std::uint32_t>(i);
    this->points_[i] = { scrambled(reversed(number), hashOf(this->seed_ + 1u)),
      scrambled(sobol(number, second), hashOf(this->seed_ + 2u)),
      scrambled(sobol(number, third), hashOf(this->seed_ + 3u)) };
  }
  const std::size_t count = this->points_.size();
  if ((count & (count - 1)) == 0)
  {
    int bits = 0;
    while ((std::size_t(1) << bits) < count)
    {
      ++bits;
    }
    this->columnBits_ = (bits + 1) / 2;
    this->rowBits_ = bits / 2;
    // Every part of the light holds one point, which takes the part's number.
    std::vector<glm::uvec3> sorted(count);
    for (const glm::uvec3& point : this->points_)
    {
      sorted[(leading(point.y, this->rowBits_) << this->columnBits_) |
        leading(point.x, this->columnBits_)] = point;
    }
    this->points_ = std::move(sorted);
  }
}

//------------------------------------------------------------------------------
LightSamples::Shift LightSamples::shiftOf(std::uint32_t column, std::uint32_t row) const
{
  const std::uint32_t pixel = hashOf(hashOf(column + this->seed_) + row);
  Shift shift;
  shift.bits = { hashOf(pixel + 1u), hashOf(pixel + 2u), hashOf(pixel + 3u) };
  shift.order = (leading(shift.bits.y, this->rowBits_) << this->columnBits_) |
    leading(shift.bits.x, this->columnBits_);
  return shift;
}

//------------------------------------------------------------------------------
glm::vec3 LightSamples::offset(int i, const Shift& shift) const
{
  // The shift moves parts of the light as wholes. What lies in part i came from this one.
  return this->placeOf(this->points_[static_cast<std::uint32_t>(i) ^ shift.order] ^ shift.bits);
}

//------------------------------------------------------------------------------
glm::vec3 LightSamples::offsetInHalf(int i) const
{
  const glm::uvec3& point = this->points_[static_cast<std::size_t>(i)];
  return this->placeOf({ point.x, point.y >> 1, point.z });
}

//------------------------------------------------------------------------------
/// The place of a point of the unit cube.
glm::vec3 LightSamples::placeOf(const glm::uvec3& point) const
{
  const glm::vec2 square(2.0f * fractionOf(point.x) - 1.0f, 2.0f * fractionOf(point.y) - 1.0f);
  if (this->shape_ == LightArea::Shape::Rectangle)
  {
    return this->worldFromUnit_ * glm::vec3(square, 0.0f);
  }
  const glm::vec2 disk = diskPoint(square);
  if (this->shape_ == LightArea::Shape::Disk)
  {
    return this->worldFromUnit_ * glm::vec3(disk, 0.0f);
  }
  // The middle of the ball's rim may be rounded to just outside of it.
  const float height = std::sqrt(std::max(1.0f - glm::dot(disk, disk), 0.0f));
  const float angle = glm::pi<float>() * (0.5f - fractionOf(point.z));
  return this->worldFromUnit_ * glm::vec3(disk, height * sineOf(angle));
}

//------------------------------------------------------------------------------
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  return light.kind == LightKind::Directional
    ? glm::dvec4(-glm::normalize(light.directionWorld), 0.0)
    : glm::dvec4(light.positionWorld - centreWorld, 1.0);
}

//------------------------------------------------------------------------------
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  const glm::dvec4 centre = lightPoint(light, centreWorld);
  if (!light.area)
  {
    return { centre };
  }
  const LightSamples points(light);
  std::vector<glm::dvec4> samples;
  samples.reserve(static_cast<std::size_t>(points.count()));
  for (int i = 0; i < points.count(); ++i)
  {
    const glm::dvec3 moved = glm::dvec3(centre) + glm::dvec3(points.offset(i, {}));
    samples.push_back(light.kind == LightKind::Directional ? glm::dvec4(glm::normalize(moved), 0.0)
                                                           : glm::dvec4(moved, 1.0));
  }
  return samples;
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> pairedLightSamples(const ShadowLight& light)
{
  if (!light.area || light.area->worldFromUnit == glm::dmat3(0.0))
  {
    return { glm::dvec3(0.0) };
  }
  ShadowLight half = light;
  half.lightSamples = light.lightSamples / 2;
  const LightSamples points(half);
  std::vector<glm::dvec3> offsets;
  for (int i = 0; i < points.count(); ++i)
  {
    offsets.emplace_back(points.offsetInHalf(i));
  }
  std::stable_sort(offsets.begin(), offsets.end(),
    [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) < glm::dot(b, b); });
  std::vector<glm::dvec3> samples;
  if (light.lightSamples % 2 == 1)
  {
    samples.emplace_back(0.0);
  }
  for (const glm::dvec3& offset : offsets)
  {
    samples.push_back(offset);
    samples.push_back(-offset);
  }
  return samples;
}

} // namespace gnomon
