#include "lights/LightSamples.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

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

std::variant<SobolPoints, HashedPoints> pointsFor(const ShadowLight& light)
{
  const auto seed = static_cast<std::uint32_t>(light.lightSeed);
  switch (light.lightSampling)
  {
    case LightSampling::Jittered:
      return HashedPoints(
        static_cast<int>(std::lround(std::sqrt(static_cast<double>(light.lightSamples)))), seed);
    case LightSampling::Random:
      return HashedPoints(1, seed);
    case LightSampling::Sobol:
      break;
  }
  return SobolPoints(light.lightSamples, seed);
}

} // namespace

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
LightSamples::LightSamples(const ShadowLight& light)
  : count_(light.lightSamples)
  , points_(pointsFor(light))
  , shape_(light.area->shape)
  , worldFromUnit_(light.area->worldFromUnit)
{
}

//------------------------------------------------------------------------------
SamplePixel LightSamples::pixel(std::uint32_t column, std::uint32_t row) const
{
  return std::visit([&](const auto& points) { return points.pixel(column, row); }, this->points_);
}

//------------------------------------------------------------------------------
glm::vec3 LightSamples::offset(int i, const SamplePixel& pixel) const
{
  return this->placeOf(
    std::visit([&](const auto& points) { return points.point(i, pixel); }, this->points_));
}

//------------------------------------------------------------------------------
glm::vec3 LightSamples::offsetInHalf(int i) const
{
  const glm::uvec3 point =
    std::visit([&](const auto& points) { return points.point(i, {}); }, this->points_);
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
