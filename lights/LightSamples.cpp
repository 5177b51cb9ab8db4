#include "lights/LightSamples.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon
{
namespace
{

/// Return a word's fraction of 2^32, in [0, 1), with as many bits as a float holds.
inline float fractionOf(std::uint32_t word)
{
  // Signed integers convert to floats faster.
  return static_cast<float>(static_cast<std::int32_t>(word >> 8)) * 5.9604645e-8f; // 2^-24
}

/// Return the sine or cosine for |angle| <= pi / 2, within 1e-7. Polynomials give the same bits on
/// all machines.
inline float sineOf(float angle)
{
  const float square = angle * angle;
  return angle *
    (1.0f -
      square * (1.0f / 6.0f) *
        (1.0f -
          square * (1.0f / 20.0f) *
            (1.0f -
              square * (1.0f / 42.0f) *
                (1.0f - square * (1.0f / 72.0f) * (1.0f - square * (1.0f / 110.0f))))));
}
inline float cosineOf(float angle)
{
  const float square = angle * angle;
  return 1.0f -
    square * (1.0f / 2.0f) *
    (1.0f -
      square * (1.0f / 12.0f) *
        (1.0f -
          square * (1.0f / 30.0f) *
            (1.0f - square * (1.0f / 56.0f) * (1.0f - square * (1.0f / 90.0f)))));
}

/// Implement diskPoint().
inline glm::vec2 concentric(const glm::vec2& square)
{
  const bool wide = std::abs(square.x) > std::abs(square.y);
  const float radius = wide ? square.x : square.y;
  const float other = wide ? square.y : square.x;
  // At the square's centre both are 0; it maps to the disk's centre.
  const float angle = glm::quarter_pi<float>() * (other / (radius == 0.0f ? 1.0f : radius));
  const float along = radius * cosineOf(angle);
  const float across = radius * sineOf(angle);
  return { wide ? along : across, wide ? across : along };
}

/// Coordinates of points of the unit cube, as fractions of 2^32, one array per axis.
struct Points
{
  static constexpr std::size_t most = 64;
  std::array<std::uint32_t, most> x, y, z;
};

/// Map points of the unit cube to offsets on a light.
/// @param unitOf takes a point's first two coordinates, scaled to [-1, 1), and its third, a
/// fraction of 2^32, to the shape of radius or half side 1
template <typename UnitOf>
inline void placeAll(const Points& points, std::size_t count, const glm::mat3& worldFromUnit,
  const UnitOf& unitOf, const LightSamples::Coordinates& to)
{
  float* const toX = to.x;
  float* const toY = to.y;
  float* const toZ = to.z;
  const glm::mat3 m = worldFromUnit;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec2 square(
      2.0f * fractionOf(points.x[i]) - 1.0f, 2.0f * fractionOf(points.y[i]) - 1.0f);
    const glm::vec3 unit = unitOf(square, points.z[i]);
    toX[i] = m[0].x * unit.x + m[1].x * unit.y + m[2].x * unit.z;
    toY[i] = m[0].y * unit.x + m[1].y * unit.y + m[2].y * unit.z;
    toZ[i] = m[0].z * unit.x + m[1].z * unit.y + m[2].z * unit.z;
  }
}

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void placePoints(const Points& points, std::size_t count, LightArea::Shape shape,
  const glm::mat3& worldFromUnit, const LightSamples::Coordinates& to)
{
  switch (shape)
  {
    case LightArea::Shape::Rectangle:
      placeAll(
        points, count, worldFromUnit,
        [](const glm::vec2& square, std::uint32_t) { return glm::vec3(square.x, square.y, 0.0f); },
        to);
      return;
    case LightArea::Shape::Disk:
      placeAll(
        points, count, worldFromUnit,
        [](const glm::vec2& square, std::uint32_t)
        {
          const glm::vec2 disk = concentric(square);
          return glm::vec3(disk.x, disk.y, 0.0f);
        },
        to);
      return;
    case LightArea::Shape::Ball:
      placeAll(
        points, count, worldFromUnit,
        [](const glm::vec2& square, std::uint32_t word)
        {
          const glm::vec2 disk = concentric(square);
          // Points of the rim may round to just outside the unit disk.
          const float height =
            std::sqrt(std::max(1.0f - (disk.x * disk.x + disk.y * disk.y), 0.0f));
          return glm::vec3(
            disk.x, disk.y, height * sineOf(glm::pi<float>() * (0.5f - fractionOf(word))));
        },
        to);
      return;
  }
}

std::variant<SobolPoints, HashedPoints> pointsFor(const ShadowLight& light)
{
  const auto seed = static_cast<std::uint32_t>(light.lightSeed);
  const int dimensions = light.area->shape == LightArea::Shape::Ball ? 3 : 2;
  switch (light.lightSampling)
  {
    case LightSampling::Jittered:
      return HashedPoints(dimensions,
        static_cast<int>(std::lround(std::sqrt(static_cast<double>(light.lightSamples)))), seed);
    case LightSampling::Random:
      return HashedPoints(dimensions, 1, seed);
    case LightSampling::Sobol:
      break;
  }
  return SobolPoints(light.lightSamples, seed);
}

} // namespace

glm::vec2 diskPoint(const glm::vec2& square)
{
  return concentric(square);
}

LightSamples::LightSamples(const ShadowLight& light)
  : count_(light.lightSamples)
  , points_(pointsFor(light))
  , shape_(light.area->shape)
  , worldFromUnit_(light.area->worldFromUnit)
{
}

SamplePixel LightSamples::pixel(std::uint32_t column, std::uint32_t row) const
{
  return std::visit([&](const auto& points) { return points.pixel(column, row); }, this->points_);
}

/// Compute offsets on the light for points of the unit cube.
/// @param pointOf returns a point by its number, below `count`, for either kind of points
template <typename PointOf>
void LightSamples::place(std::size_t count, const PointOf& pointOf, const Coordinates& to) const
{
  std::visit(
    [&](const auto& points)
    {
      Points some; // not cleared
      for (std::size_t from = 0; from < count; from += Points::most)
      {
        const std::size_t part = std::min(Points::most, count - from);
        for (std::size_t i = 0; i < part; ++i)
        {
          const glm::uvec3 point = pointOf(points, from + i);
          some.x[i] = point.x;
          some.y[i] = point.y;
          some.z[i] = point.z;
        }
        placePoints(some, part, this->shape_, this->worldFromUnit_,
          { to.x + from, to.y + from, to.z + from });
      }
    },
    this->points_);
}

glm::vec3 LightSamples::offset(int i, const SamplePixel& pixel) const
{
  glm::vec3 offset;
  this->place(1, [&](const auto& points, std::size_t) { return points.point(i, pixel); },
    { &offset.x, &offset.y, &offset.z });
  return offset;
}

void LightSamples::offsets(const std::uint32_t* samples, const SamplePixel* pixels,
  std::size_t count, const Coordinates& to) const
{
  this->place(
    count,
    [&](const auto& points, std::size_t i)
    { return points.point(static_cast<int>(samples[i]), pixels[i]); },
    to);
}

void LightSamples::offsets(const SamplePixel& pixel, const Coordinates& to) const
{
  this->place(
    static_cast<std::size_t>(this->count_),
    [&](const auto& points, std::size_t i) { return points.point(static_cast<int>(i), pixel); },
    to);
}

glm::vec3 LightSamples::offsetInHalf(int i) const
{
  glm::vec3 offset;
  this->place(1,
    [&](const auto& points, std::size_t)
    {
      const glm::uvec3 point = points.point(i, {});
      return glm::uvec3(point.x, point.y >> 1, point.z);
    },
    { &offset.x, &offset.y, &offset.z });
  return offset;
}

glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  return light.kind == LightKind::Directional
    ? glm::dvec4(-glm::normalize(light.directionWorld), 0.0)
    : glm::dvec4(light.positionWorld - centreWorld, 1.0);
}

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

std::size_t pairedPointsWanted(std::size_t all, std::size_t before, std::size_t perFrame)
{
  if (perFrame == 0)
  {
    return all;
  }
  const std::size_t wanted = std::min(all, before + perFrame);
  return wanted + (all - wanted) % 2;
}

bool isSquare(int samples)
{
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(samples))));
  return side * side == samples;
}

std::string refusedSamples(const ShadowLight& light)
{
  return light.area && light.lightSampling == LightSampling::Jittered &&
      !isSquare(light.lightSamples)
    ? "'light_sampling' jittered has one sample in each cell of a square grid, of which there are "
      "no " +
      std::to_string(light.lightSamples) + "; 'light_samples' takes squares then: 4, 9, 16, ..."
    : "";
}

} // namespace gnomon
