#include "shadowtech/sky/Sky.h"

#include "lights/LightSamples.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon
{
namespace
{

constexpr std::uint32_t seedOfSky = 16;
/// Keeps rays off the receiver's plane, along which their rounding counts most.
constexpr float leastCosine = 0.0009765625f; // 2^-10

int bitsOf(int count)
{
  int bits = 0;
  while (1 << bits < count)
  {
    ++bits;
  }
  return bits;
}

} // namespace

float radianceOf(const Sky& sky, const glm::vec3& direction)
{
  if (sky.model == SkyModel::Uniform)
  {
    return 1.0f;
  }
  const float sine = glm::dot(sky.up, direction);
  if (!(sine > 0.0f))
  {
    return 0.0f;
  }
  return sky.model == SkyModel::Dome ? 1.0f : 3.0f / 7.0f * (1.0f + 2.0f * sine);
}

double openView(const Sky& sky, const glm::vec3& normal)
{
  if (sky.model == SkyModel::Uniform)
  {
    return 1.0;
  }
  const double cosine = glm::clamp(glm::dot(glm::dvec3(sky.up), glm::dvec3(normal)), -1.0, 1.0);
  const double dome = 0.5 * (1.0 + cosine);
  if (sky.model == SkyModel::Dome)
  {
    return dome;
  }
  const double pi = glm::pi<double>();
  const double angle = std::acos(cosine);
  return 3.0 / 7.0 * dome + 4.0 / (7.0 * pi) * (std::sin(angle) + (pi - angle) * cosine);
}

SkyDirections::SkyDirections(int count)
  : count_(count)
  , columnBits_((bitsOf(count) + 1) / 2)
  , points_(count, seedOfSky)
{
}

bool SkyDirections::isCount(int count)
{
  return count >= static_cast<int>(batches) && count <= 65536 && (count & (count - 1)) == 0;
}

glm::vec3 SkyDirections::local(int i, const SamplePixel& pixel) const
{
  const glm::uvec3 fractions = this->points_.point(i, pixel);
  // Fractions of 2^32 as floats of the square of half side 1.
  const glm::vec2 disk = diskPoint((glm::vec2(fractions) + 0.5f) * 4.656612873e-10f - 1.0f);
  const float z = std::max(std::sqrt(std::max(1.0f - glm::dot(disk, disk), 0.0f)), leastCosine);
  return { disk.x, disk.y, z };
}

std::size_t SkyDirections::batchOf(int i) const
{
  constexpr std::size_t order[4][4] = { { 0, 8, 2, 10 }, { 12, 4, 14, 6 }, { 3, 11, 1, 9 },
    { 15, 7, 13, 5 } };
  return order[i >> this->columnBits_ & 3][i & 3];
}

glm::mat3 rotationFromZ(const glm::vec3& to)
{
  const float sign = std::copysign(1.0f, to.z);
  const float a = -1.0f / (sign + to.z);
  const float b = to.x * to.y * a;
  return { { 1.0f + sign * to.x * to.x * a, sign * b, -sign * to.x },
    { b, sign + to.y * to.y * a, -to.y }, to };
}

double SkySums::view(double open) const
{
  const double all = std::accumulate(this->all_.begin(), this->all_.end(), 0.0);
  return all > 0.0 ? open * std::accumulate(this->seen_.begin(), this->seen_.end(), 0.0) / all
                   : 0.0;
}

double SkySums::error(double open) const
{
  const double all = std::accumulate(this->all_.begin(), this->all_.end(), 0.0);
  if (!(all > 0.0))
  {
    return 0.0;
  }
  const double share = std::accumulate(this->seen_.begin(), this->seen_.end(), 0.0) / all;
  double squares = 0.0;
  for (std::size_t batch = 0; batch < SkyDirections::batches; ++batch)
  {
    const double off = this->seen_[batch] - share * this->all_[batch];
    squares += off * off;
  }
  // The variance of a ratio of sums (Cochran 1977, section 6.3).
  constexpr double count = SkyDirections::batches;
  return open * std::sqrt(squares * count / (count - 1.0)) / all;
}

} // namespace gnomon
